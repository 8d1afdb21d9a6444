"""Places across the ideal path, of steps, table and wire, and what sums them up; the border type is `Deviations`."""
