"""Forms and splines seen from above, as lines and arcs in µm; the border type is `Flat`."""
