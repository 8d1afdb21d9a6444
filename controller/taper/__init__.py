"""The wire that tilts: a path and its angles to the contours of two planes, matched row by row.

A `Toolpath` goes in with the heights of work and guides; a `TiltedPath` comes out.
"""
