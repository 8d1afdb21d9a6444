"""How far off wire and edge are; what crosses the border: `Deviations`, `Comparison` and `PassFigures`."""
