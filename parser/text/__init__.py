"""Bytes, characters, lines, and places in them; the border is text, its `LineIndex`, and the `Source` of its blocks."""
