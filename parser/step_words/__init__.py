"""Lines and arcs as a counting controller is told them, and what it makes of that; the border type is `StepWords`."""
