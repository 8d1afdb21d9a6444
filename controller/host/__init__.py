"""The host's part: what a program on the machine's computer tells the card to do.

A `Drive` goes in; the card's `Pulses` come out.
"""
