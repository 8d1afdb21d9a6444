"""What every room of the card shares: calls and their C types, codes, settings, units, what a card remembers.

Across its border go `CardSettings` and `CardState`; a body that says no raises `Refused`.
"""
