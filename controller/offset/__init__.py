"""Wire offset: the path of the wire's centre beside a drawing's contour.

`compensate` makes it block by block, as a controller does; `reach` tells where a wire can run without cutting into the
contour; `gouges` and `uncut_um` hold the one against the other: what is cut too much, and what stays.

A `Toolpath` goes in with its sections; an `OffsetPath` comes out.
"""
