"""The functions of the card's library, in groups."""
