"""Bytes, characters, lines, and the places in them; the border is text with its `LineIndex` and its blocks' `Source`."""
