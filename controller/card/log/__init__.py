"""The log of a card: written, read, and replayed call by call. A `Logged` call is a line of it."""
