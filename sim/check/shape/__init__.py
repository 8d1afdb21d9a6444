"""What is wrong with the shape of contours: tight corners, crossings, arcs that turn the wrong way."""
