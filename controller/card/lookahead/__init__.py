"""Look-ahead as the card's library has it: blocks are kept back until the speed at their end is known.

A `HostBlock` goes in and comes out `OldestBlock`, with its speeds; `Mode` is how a card's look-ahead stands.
"""
