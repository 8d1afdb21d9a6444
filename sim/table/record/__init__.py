"""What is kept of a run of the table: its ticks in order, losses, peaks; the border type is `History`."""
