"""Loops of a drawing nested into parts, each an outline with its holes; the border type is `Parts`."""
