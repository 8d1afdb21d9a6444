"""The host's part: what a program on the machine's computer tells the card to do."""
