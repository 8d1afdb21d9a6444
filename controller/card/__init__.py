"""The emulated GE motion card: `GECard` with every function of the card's library under its C name.

Calls go in, over simulated time; `Pulses` come out.
"""
