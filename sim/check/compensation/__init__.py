"""The compensation that a program asks for itself, by G41 and G42: its words, and the path that comes of it."""
