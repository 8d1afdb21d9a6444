"""Text to toolpath, DXF to drawing: the only package that knows how they are written; gives `Program` and `Drawing`."""
