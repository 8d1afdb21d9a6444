"""Hypothesis strategies for 3B blocks, and the plain text of them."""

from hypothesis import strategies as st
from plain import PlainBlock

EXTENT = st.one_of(st.integers(0, 12), st.integers(0, 400))


@st.composite
def lines(draw: st.DrawFn) -> PlainBlock:
    """Lines in all quadrants, on axes and at 45°, reduced or not, also with a neighbour's label."""
    x, y = draw(EXTENT), draw(EXTENT)
    axes = [axis for axis, extent in (("X", x), ("Y", y)) if extent]
    if not axes:
        x, axes = 1, ["X"]
    if draw(st.booleans()) and x:
        y, axes = x, ["X", "Y"]
    return PlainBlock(x, y, draw(st.integers(1, 900)), draw(st.sampled_from(axes)), "L", draw(st.integers(1, 4)))


@st.composite
def arcs(draw: st.DrawFn, longest_turns: int = 3) -> PlainBlock:
    """Arcs of R² > 1 in both senses from anywhere, axes included, up to some turns."""
    x, y = draw(EXTENT), draw(EXTENT)
    if x * x + y * y <= 1:
        x, y = 2, 0
    most = int(4 * longest_turns * (x * x + y * y) ** 0.5)
    full = round(4 * (x * x + y * y) ** 0.5)
    count = draw(st.one_of(st.integers(1, most), st.just(full)))
    sense = draw(st.sampled_from(["NR", "SR"]))
    return PlainBlock(x, y, count, draw(st.sampled_from("XY")), sense, draw(st.integers(1, 4)))


blocks = st.one_of(lines(), arcs())
programs = st.lists(blocks, min_size=1, max_size=12)


def program_text(program: list[PlainBlock]) -> str:
    return "\n".join(block.text() for block in program) + "\nDD\n"
