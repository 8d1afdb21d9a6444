"""A program on a machine, from start to end; what crosses the border is a `DryRun`, and the dict of its report."""
