"""Films of a run, and the window that plays it: the same frames; the border type is a frame's `Pixels`."""
