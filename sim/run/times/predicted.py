"""What a program takes by the machine file and the shop's times, term by term, before the shop's own cuts are known."""

import math
from collections.abc import Mapping
from typing import Final, Literal, NamedTuple

import numpy as np

from parser.geometry.along import directions
from parser.program import Program
from parser.shape.contours import contour_rows, runs
from parser.shape.passes import find_passes, most_passes
from parser.toolpath import Toolpath
from parser.units import from_mm, mm
from sim.run.prepare import prepare, time_spread_s
from sim.setup.machine.machine import CUTTING
from sim.setup.scenario import Scenario
from sim.setup.shop import Shop
from sim.setup.technology import Grade as FeedGrade
from sim.setup.technology import Technology, worst_grade

Grade = Literal["measured", "set", "assumed"]
"""Where a number comes from: a shop's own cuts, a file of the shop's, or nobody who measured it."""
_GRADES: Final[Mapping[FeedGrade, Grade]] = {"measured": "measured", "maker": "set", "assumed": "assumed"}
_CORNER_RAD: Final = math.radians(30.0)
"""A sharper turn is a corner, at which the wire may stand (assumed)."""


class Term(NamedTuple):
    """A part of a time.

    Attributes
    ----------
    name
        Of its text for people, ``time.term-…``.
    minutes
        How much it takes.
    grade
        Where its number comes from.
    times
        How often it occurs; None where that is no matter.
    """

    name: str
    minutes: float
    grade: Grade
    times: int | None = None


class Predicted(NamedTuple):
    """What a program takes, as predicted.

    Attributes
    ----------
    name, length_mm, height_mm, passes
        Its file; the way that is cut, all passes; the thickness of the work; the most passes over one edge, without
        those over its tab.
    terms
        What it takes, in parts.
    technology, less_min, more_min
        What says its feeds, if anything, and by how much they may leave it shorter and longer.
    """

    name: str
    length_mm: float
    height_mm: float
    passes: int
    terms: tuple[Term, ...]
    technology: Technology | None = None
    less_min: float = 0.0
    more_min: float = 0.0

    @property
    def minutes(self) -> float:
        """All of it."""
        return sum(term.minutes for term in self.terms)


def predicted(program: Program, scenario: Scenario, shop: Shop) -> Predicted:
    """What a program takes on the machine of a scenario.

    Each row takes its length over its feed: that of its pass, else the area rate of the machine over the thickness.
    Raises what `prepare` does.
    """
    ready = prepare(program, scenario)
    path, feeds = ready.program.toolpath, ready.feeds
    cut = ~path.is_jump
    feed = np.broadcast_to(np.asarray(feeds.cut_um_s, dtype=np.float64), len(path))
    row_s = np.where(cut, path.length_um / feed, 0.0)
    cut_min = float(row_s.sum()) / 60.0
    jump_min = float(path.length_um[~cut].sum()) / feeds.jump_um_s / 60.0
    starts = len(runs(path))
    found = find_passes(path) if ready.offset is None else ready.offset.edge_passes
    spread_s = (0.0, 0.0) if scenario.technology is None else time_spread_s(path, found, row_s, scenario)
    counts = {"threading": max(starts - 1, 0), "pierce": starts, "corners": _corners(path)}
    return Predicted(
        name=program.name,
        length_mm=mm(float(path.length_um[cut].sum())),
        height_mm=scenario.thickness_mm,
        passes=most_passes(found),
        terms=tuple(_terms(cut_min, jump_min, counts, scenario, shop)),
        technology=scenario.technology,
        less_min=spread_s[0] / 60.0,
        more_min=spread_s[1] / 60.0,
    )


def predicted_way(length_mm: float, passes: int, scenario: Scenario) -> float:
    """Minutes that a way of a length takes in so many passes: as the technology has them, else as the machine does."""
    feeds = [scenario.technology_feed_um_s(number) for number in range(1, passes + 1)]
    return sum(from_mm(length_mm) / feed_um_s for feed_um_s in feeds) / 60.0


def _terms(cut_min: float, jump_min: float, counts: dict[str, int], scenario: Scenario, shop: Shop) -> list[Term]:
    """The terms of a time; those of which nothing is known, and that take nothing, are left out."""
    times = shop.times
    is_assumed = scenario.machine_by_default or CUTTING.keys[0].name in scenario.machine.assumed
    grade: Grade = "assumed" if is_assumed else "set"
    if scenario.technology is not None:
        feeds = [of_pass.feed_mm_min for of_pass in scenario.pass_technologies]
        grade = _GRADES[worst_grade("assumed" if feed is None else feed.grade for feed in feeds)]
    reversals = cut_min * times.reversal_s / times.reversal_every_s
    breaks = cut_min / 60.0 * times.breaks_per_h * times.break_min
    of_shop = (
        ("threading", counts["threading"] * times.threading_min, "threading_min", counts["threading"]),
        ("pierce", counts["pierce"] * times.pierce_min, "pierce_min", counts["pierce"]),
        ("corners", counts["corners"] * times.corner_wait_s / 60.0, "corner_wait_s", counts["corners"]),
        ("reversals", reversals, "reversal_s", None),
        ("breaks", breaks, "breaks_per_h", None),
    )
    return [
        Term("cut", cut_min, grade),
        *([Term("jumps", jump_min, "set")] if jump_min else []),
        *(
            Term(name, minutes, "set" if key in shop.given else "assumed", count)
            for name, minutes, key, count in of_shop
            if minutes
        ),
    ]


def _corners(path: Toolpath) -> int:
    """How many corners of cut rows are sharper than `_CORNER_RAD`."""
    ways, contour = directions(path), contour_rows(path)
    (x, y), (to_x, to_y) = ways.arriving[:-1].T, ways.leaving[1:].T
    turn = np.abs(np.arctan2(x * to_y - y * to_x, x * to_x + y * to_y))
    return int(((turn > _CORNER_RAD) & (contour[:-1] == contour[1:]) & (contour[1:] >= 0)).sum())
