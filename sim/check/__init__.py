"""``drycut check``: everything that is wrong with programs, without moving a table."""
