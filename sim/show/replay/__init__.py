"""The replay: a page in which a run is watched again, forward and back, down to its single steps."""
