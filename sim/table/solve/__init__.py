"""The table over a whole run, many stretches of time at once."""
