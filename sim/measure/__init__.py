"""How far off wire and edge are, from path and drawing; what crosses the border: `Deviations` and `Comparison`."""
