"""Shape of contours: loops, crossings, senses of arcs, tight corners."""
