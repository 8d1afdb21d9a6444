"""Loops compiled to machine code, for what goes on step by step; the way in is the decorator `compiled`."""
