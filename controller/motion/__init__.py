"""Motion in time: the path, the limits along it, and the plan that keeps them. `Path`, `RowLimits` in, `Plan` out."""
