"""What the host tells the card of a toolpath: the entries of its list, as columns in the card's units."""

from typing import Literal, NamedTuple

import numpy as np

from controller.card.core.settings import UM_S2_PER_PULSE_MS2, UM_S_PER_PULSE_MS
from controller.motion.plan import Plan
from controller.motion.planner import RowLimits
from parser.controller_words import StepWords
from parser.geometry.curves import Floats, Ints
from parser.toolpath import Toolpath

Interpolation = Literal["point-by-point", "card"]
"""How a path becomes steps: as 3B controllers do, or by the card's own interpolation at equal times."""

STANDING_UM_S = 1e-6
"""Slower than this, a pulse in eleven days, is at rest: what rounding leaves of a stop at a full turn."""


class Drive(NamedTuple):
    """What is driven.

    Attributes
    ----------
    toolpath, limits, plan
        The path, the limits that its motion has to keep, and the plan under these limits; the host sleeps by the plan.
    origin_um
        Where the axes stand at the start, whole µm of the program; a start between whole µm shifts all steps alike.
    interpolation
        How the card makes steps of the path.
    """

    toolpath: Toolpath
    limits: RowLimits
    plan: Plan
    origin_um: tuple[int, int]
    interpolation: Interpolation


class Entries(NamedTuple):
    """m entries of the list; all (m,) but the places, which are (m, 2) from where the axes stand at the start.

    Attributes
    ----------
    row
        Row of the toolpath; rows without length make no entry, nor do blocks that whole µm leave no steps, arcs of more
        than one turn several.
    end_um, center_um
        Ends, and centres of arcs.
    angle_deg
        Of arcs, positive counter-clockwise; 0 on lines.
    speed_pulse_ms, acceleration_pulse_ms2
        In the entry.
    end_pulse_ms
        Highest speed at its end; NaN where only the speeds of the entries limit it.
    wait_ms
        Time to stand still at its end, whole ms.
    """

    row: Ints
    end_um: Floats
    center_um: Floats
    angle_deg: Floats
    speed_pulse_ms: Floats
    acceleration_pulse_ms2: Floats
    end_pulse_ms: Floats
    wait_ms: Ints


def entries_of(drive: Drive, words: StepWords | None = None) -> Entries:
    """Entries of a whole toolpath, which the card steps by its `words`, one for each row, where they are given."""
    toolpath, limits = drive.toolpath, drive.limits
    moves = limits.length_um > 0.0
    kept_rows = np.flatnonzero(moves if words is None else moves & (words.count_um > 0))
    if not len(kept_rows):
        empty, pairs = np.zeros(0), np.zeros((0, 2))
        return Entries(kept_rows, pairs, pairs, empty, empty, empty, empty, kept_rows)
    # The borders from each kept row's end to the start of the next kept one are one place.
    ends_at = np.minimum.reduceat(limits.border_um_s, kept_rows + 1)
    waits = np.add.reduceat(limits.wait_s, kept_rows + 1)
    ahead = np.append(limits.speed_um_s[kept_rows[1:]], np.inf)
    is_told = ends_at < np.minimum(limits.speed_um_s[kept_rows], ahead)
    is_told[-1] = False  # the list ends at the start speed by itself
    turns = _turns(toolpath.sweep_rad[kept_rows], drive.interpolation)
    row = np.repeat(kept_rows, turns)
    last = np.cumsum(turns) - 1
    end, wait = np.full(len(row), np.nan), np.zeros(len(row), dtype=np.int64)
    end[last] = np.where(is_told, np.where(ends_at < STANDING_UM_S, 0.0, ends_at), np.nan) / UM_S_PER_PULSE_MS
    wait[last] = np.rint(waits * 1e3).astype(np.int64)
    origin = toolpath.start_um[0]
    return Entries(
        row=row,
        end_um=toolpath.end_um[row] - origin,
        center_um=toolpath.center_um[row] - origin,
        angle_deg=np.degrees(toolpath.sweep_rad[row]) / np.repeat(turns, turns),
        speed_pulse_ms=limits.speed_um_s[row] / UM_S_PER_PULSE_MS,
        acceleration_pulse_ms2=limits.acceleration_um_s2[row] / UM_S2_PER_PULSE_MS2,
        end_pulse_ms=end,
        wait_ms=wait,
    )


def _turns(sweep_rad: Floats, interpolation: Interpolation) -> Ints:
    """Entries that each row takes: an arc of the card's own turns by 360° at most."""
    if interpolation == "point-by-point":
        return np.ones(len(sweep_rad), dtype=np.int64)
    return np.maximum(np.ceil(np.abs(sweep_rad) / (2.0 * np.pi) - 1e-12), 1.0).astype(np.int64)


def blocks_told(drive: Drive, entries: Entries, words: StepWords) -> list[tuple[float, ...]]:
    """What `step_block` is given for each entry: the words of its block, and the length µm."""
    row = entries.row
    columns = words.x_um, words.y_um, words.count_um, words.count_axis, words.quadrant, words.turn
    return list(zip(*(column[row].tolist() for column in (*columns, drive.limits.length_um)), strict=True))


def shapes_told(entries: Entries) -> list[tuple[float, ...]]:
    """What `GT_LnXY` is given for each line, the end, and `GT_ArcXY` for each arc, centre and angle; user units, °."""
    ends, centers, angles = (column.tolist() for column in (entries.end_um, entries.center_um, entries.angle_deg))
    return [(*center, angle) if angle else tuple(end) for end, center, angle in zip(ends, centers, angles, strict=True)]
