"""Offsets held against the kerf of their pass, as a technology has it: of a header, or of a program's own registers."""

from collections.abc import Iterator
from typing import NamedTuple

from parser.dialect.reader import at_block
from parser.findings.findings import Finding
from parser.program import Program
from parser.shape.passes import Pass, Passes
from sim.setup.technology import PassTechnology, pass_of


class Reach(NamedTuple):
    """Half the width of a kerf, µm, and by how much it may be less, below 0, and by how much more."""

    um: float
    less_um: float
    more_um: float


class Kerfs(NamedTuple):
    """How a wire of a radius cuts in each pass, as a technology has it."""

    radius_um: float
    passes: tuple[PassTechnology, ...]

    def reach(self, number: int) -> Reach:
        """That of a pass, from 1."""
        gap = pass_of(self.passes, number).gap_um
        return Reach(self.radius_um + gap.value, gap.least - gap.value, gap.most - gap.value)


def misfit(program: Program, of: Pass, offset_um: float, reach: Reach) -> Finding | None:
    """Finding 3B607 of a pass that leaves an edge beside its contour, whatever its gap turns out to be."""
    if of.shift_um > of.edge_um or reach.less_um <= offset_um - reach.um <= reach.more_um:
        return None
    values = {
        "offset": offset_um,
        "reach": reach.um,
        "least": reach.um + reach.less_um,
        "most": reach.um + reach.more_um,
        "by": abs(offset_um - reach.um),
    }
    return at_block(program.toolpath, program.lines, "3B607", of.first, number=of.number, **values)


def misfits(program: Program, passes: Passes, kerfs: Kerfs, header_um: float | None) -> Iterator[Finding]:
    """Findings 3B607 of the passes of a program whose offsets are known: each its own, else that of the header."""
    for of in passes.passes:
        offset_um = header_um if of.told_um is None else of.told_um
        if offset_um is not None and (found := misfit(program, of, offset_um, kerfs.reach(of.number))) is not None:
            yield found
