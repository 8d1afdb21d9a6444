"""What is wrong with the shape of contours: corners, crossings, reversed arcs; the border type is `Finding`."""
