"""What is kept of a run of the table: its ticks in order of time, and their history, losses and peaks."""
