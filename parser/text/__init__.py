"""Bytes, characters, lines, and the places in them; what crosses the border is text with its `LineIndex`."""
