"""Films of a run, and the window that plays it: the same frames, written one after the other or shown."""
