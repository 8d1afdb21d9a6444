"""What moves behind the functions of the card."""
