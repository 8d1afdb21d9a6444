"""Ellipses, splines and dense polylines as few arcs, within a proved tolerance; the border type is `FitFigures`."""
