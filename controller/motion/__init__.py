"""Motion in time: the path, the limits that hold along it, and the plan that keeps them. `RowLimits` in, `Plan` out."""
