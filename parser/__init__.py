"""Text to toolpath, DXF to drawing: the only package that knows how they are written; gives `Program` and `Drawing`."""

__version__ = "0.1.0"
"""Of drycut: of all three packages, which are shipped together."""
