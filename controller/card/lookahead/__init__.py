"""Look-ahead as the card's library has it."""
