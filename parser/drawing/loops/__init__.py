"""Curves chained to loops, each drawn once; the border type is `Chained`."""
