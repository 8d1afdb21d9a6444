"""A program on a machine, from start to end; what crosses the border are `DryRun`, `Recording`, `Course`, report."""
