"""Each block of a program decoded, and the way that it then takes through compensation (docs/iso.md §8)."""

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from controller.offset.chain import RowOrigin
from controller.offset.joints import (
    AsideEnds,
    JointKind,
    aside_ends,
    joint_kinds,
)
from controller.offset.programmed import compensated
from parser.dialect.decoding import DecodedBlock
from parser.geometry.curves import CurveKind, Floats
from parser.program import Program
from parser.toolpath import Point, Toolpath


class Way(NamedTuple):
    """What a block moves, as it runs for the first time.

    Attributes
    ----------
    row, runs
        Its row of the toolpath from 0, and how often it runs.
    kind
        ``line``, ``arc`` or ``jump``.
    start_um, end_um, length_um
        Of the contour, as programmed.
    left_um, right_um
        Its end moved aside to the left, P′, and to the right, P″; None without offset.
    wire_center_um
        Where it ends on the path of the wire's centre, behind all joints; None without offset, and where it has no
        place on that path.
    arc_center_um
        Of the contour's arc, as read; None of lines and jumps.
    joint
        How it goes on from the block before it, and the line of that block; None and 0 without compensation.
    """

    row: int
    runs: int
    kind: str
    start_um: Point
    end_um: Point
    length_um: float
    left_um: Point | None
    right_um: Point | None
    wire_center_um: Point | None
    arc_center_um: Point | None
    joint: JointKind
    before_line: int


class Decoded(NamedTuple):
    """A block decoded, and its way; None where it moves nothing."""

    block: DecodedBlock
    way: Way | None


def decoded(program: Program, contour: Toolpath) -> tuple[Decoded, ...]:
    """The blocks of a program in file order, along its contour; none where its dialect has no decoder."""
    if program.decoder is None:
        return ()
    ways = _ways(contour)
    return tuple(Decoded(block, ways.get(block.span[0])) for block in program.decoder.blocks())


def _ways(toolpath: Toolpath) -> Mapping[int, Way]:
    """Ways of the blocks, by their first characters in the text."""
    first, row, runs = np.unique(toolpath.source.span[:, 0], return_index=True, return_counts=True)
    compensation = toolpath.compensation
    stage = (
        None
        if compensation is None
        else _Stage(aside_ends(toolpath, compensation), _center_ends(toolpath), joint_kinds(toolpath, compensation))
    )
    found = zip(first.tolist(), row.tolist(), runs.tolist(), strict=True)
    return {first: _way(toolpath, row, runs, stage) for first, row, runs in found}


class _Stage(NamedTuple):
    """Compensation of a toolpath: what is told of it, ends moved aside, on the centre's path (n, 2), and joints."""

    ends: AsideEnds
    wire_center_um: Floats
    joints: tuple[JointKind, ...]


def _way(toolpath: Toolpath, row: int, runs: int, stage: _Stage | None) -> Way:
    block = toolpath.block(row)
    alone = Way(
        row=row,
        runs=runs,
        kind=CurveKind(block.kind).name.lower(),
        start_um=block.start_um,
        end_um=block.end_um,
        length_um=block.length_um,
        left_um=None,
        right_um=None,
        wire_center_um=None,
        arc_center_um=block.center_um,
        joint=JointKind.NONE,
        before_line=0,
    )
    if stage is None:
        return alone
    return alone._replace(
        left_um=_place(stage.ends.left_um[row].tolist()),
        right_um=_place(stage.ends.right_um[row].tolist()),
        wire_center_um=_place(stage.wire_center_um[row].tolist()),
        joint=stage.joints[row],
        before_line=int(toolpath.source.line[row - 1]) if row and stage.joints[row] != JointKind.NONE else 0,
    )


def _center_ends(toolpath: Toolpath) -> Floats:
    """Ends (n, 2) of blocks on the path of the wire's centre; NaN of those without offset or place."""
    path = compensated(toolpath).path
    own = np.flatnonzero((path.made == RowOrigin.SHIFTED) | (path.made == RowOrigin.LEAD))
    ends = np.full((len(toolpath), 2), np.nan)
    ends[path.source_row[own]] = path.curves.end_um[own]
    return ends


def _place(pair: list[float]) -> Point | None:
    return None if np.isnan(pair).any() else Point(*pair)
