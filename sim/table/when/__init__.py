"""When to look at the table: fine where it is shaken, long where nothing happens; the border type is `Ticks`."""
