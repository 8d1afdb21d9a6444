"""The machine: table, drives and controller, as machine files tell them; what crosses the border is a `Machine`."""
