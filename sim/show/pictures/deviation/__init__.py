"""Deviation: along the path, on the path, around circles, as a share of the path, and its worst places close up."""
