"""Places across the ideal path, of steps, table and wire, and the figures that sum them up."""
