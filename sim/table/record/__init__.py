"""What is kept of a run of the table: ways, history, losses and peaks."""
