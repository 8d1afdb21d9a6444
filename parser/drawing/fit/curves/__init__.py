"""Smooth curves as rational pieces, and the fewest arcs near them; the border types are `Pieces` and `Arcs`."""
