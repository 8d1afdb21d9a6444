"""Blame: of all words that might explain what is wrong with a block or a contour, the one that does; `settled`."""
