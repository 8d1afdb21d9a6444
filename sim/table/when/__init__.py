"""When to look at the table: ticks, fine where it is shaken and long where nothing happens."""
