"""Look-ahead as the card's library has it: blocks are kept back until the speed at their end is known.

Across its border go `HostBlock`, a block that is kept, and `Told`, the block with its speeds.
"""
