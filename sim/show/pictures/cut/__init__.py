"""The cut path: workpiece, kerf, parts, the path itself, and what the shop needs to read it."""
