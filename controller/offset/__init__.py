"""Wire offset: the path of the wire's centre beside a drawing's contour.

`rounds_of` finds what runs along the contours, `in_passes` runs each once for each pass. `compensate` makes the path
block by block, as a controller does; `compensated` does so where the program itself says along which blocks, and by
how much. `reach` tells where a wire can run without cutting into the contour. `gouges` and `uncut_um` compare a path
with its contour: where it cuts too much, and what it leaves uncut.

A `Toolpath` goes in with its sections; an `OffsetPath` comes out.
"""
