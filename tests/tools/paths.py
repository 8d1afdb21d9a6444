"""Toolpaths drawn block by block, exact, or rounded to whole µm the way CAM output is."""

import math
from dataclasses import fields
from typing import Self

import numpy as np

from parser.controller_words import StepWords
from parser.geometry.curves import CurveKind, Curves
from parser.step_words.words import arc_ends
from parser.text.source import Source
from parser.toolpath import Toolpath


class Pen:
    """Draws a toolpath; `cam` rounds every block to 3B words and goes on from its decoded end, as a CAM does."""

    def __init__(self, x: float = 0.0, y: float = 0.0, *, cam: bool = False) -> None:
        self.x, self.y, self.cam = x, y, cam
        self.rows: list[tuple] = []

    def to(self, x: float, y: float, kind: CurveKind = CurveKind.LINE) -> Self:
        if self.cam:
            x, y = self.x + round(x - self.x), self.y + round(y - self.y)
        length = math.hypot(x - self.x, y - self.y)
        self.rows.append((kind, (self.x, self.y), (x, y), (math.nan, math.nan), math.nan, math.nan, 0.0, length))
        self.x, self.y = x, y
        return self

    def jump(self, x: float, y: float) -> Self:
        return self.to(x, y, CurveKind.JUMP)

    def arc(self, cx: float, cy: float, sweep: float) -> Self:
        """Arc about (cx, cy) by `sweep` rad, positive counter-clockwise."""
        if self.cam:
            return self._cam_arc(cx, cy, sweep)
        radius = math.hypot(self.x - cx, self.y - cy)
        start = math.atan2(self.y - cy, self.x - cx)
        end = (cx + radius * math.cos(start + sweep), cy + radius * math.sin(start + sweep))
        return self._add_arc((cx, cy), end, radius, start, sweep)

    def arc_to(self, x: float, y: float, cx: float, cy: float, turn: int) -> Self:
        """Arc about (cx, cy) to (x, y), counter-clockwise with turn +1."""
        by = math.atan2(y - cy, x - cx) - math.atan2(self.y - cy, self.x - cx)
        return self.arc(cx, cy, turn * ((by * turn) % (2.0 * math.pi)))

    def _cam_arc(self, cx: float, cy: float, sweep: float) -> Self:
        words = np.array([[round(self.x - cx), round(self.y - cy)]])
        turn = 1 if sweep > 0 else -1
        start = math.atan2(self.y - cy, self.x - cx)
        end = start + sweep
        on_y = abs(math.cos(end)) > abs(math.sin(end))
        # The counted length is the integral of |sin| on X, of |cos| on Y.
        shift = math.pi / 2.0 if on_y else 0.0
        radius = math.hypot(*words[0])
        count = round(radius * abs(_counted(end + shift) - _counted(start + shift)))
        ends = arc_ends(words, np.array([max(count, 1)]), np.array([int(on_y)]), np.array([turn]))
        center = (self.x - int(words[0, 0]), self.y - int(words[0, 1]))
        place = (center[0] + float(ends.end_um[0, 0]), center[1] + float(ends.end_um[0, 1]))
        return self._add_arc(
            center, place, float(ends.radius_um[0]), float(ends.start_angle_rad[0]), float(ends.sweep_rad[0])
        )

    def _add_arc(
        self, center: tuple[float, float], end: tuple[float, float], radius: float, start: float, sweep: float
    ) -> Self:
        self.rows.append((CurveKind.ARC, (self.x, self.y), end, center, radius, start, sweep, radius * abs(sweep)))
        self.x, self.y = end
        return self

    def path(self) -> Toolpath:
        kind, start, end, center, radius, angle, sweep, length = zip(*self.rows, strict=True)
        return toolpath_of(
            Curves(
                kind=np.array(kind, dtype=np.int64),
                start_um=np.array(start, dtype=float),
                end_um=np.array(end, dtype=float),
                center_um=np.array(center, dtype=float),
                radius_um=np.array(radius, dtype=float),
                start_angle_rad=np.array(angle, dtype=float),
                sweep_rad=np.array(sweep, dtype=float),
                length_um=np.array(length, dtype=float),
            )
        )


def toolpath_of(curves: Curves) -> Toolpath:
    """A toolpath of curves alone, without text."""
    n = len(curves)
    none = np.zeros(n, dtype=np.int64)
    return Toolpath(
        **{field.name: getattr(curves, field.name) for field in fields(Curves)},
        printed_end_um=np.full((n, 2), np.nan),
        words=StepWords(none, none, none, none, none, none, none, none),
        source=Source("", np.arange(1, n + 1), np.zeros((n, 2), dtype=np.int64), none, ("",) * n),
        stops=(),
    )


def _counted(angle: float) -> float:
    turns, rest = divmod(angle, math.pi)
    return 2.0 * turns + 1.0 - math.cos(rest)


def flipped(curves: Curves) -> Curves:
    """The same curves run through backwards, each and all."""
    back = curves.picked(slice(None, None, -1))
    return Curves(
        kind=back.kind,
        start_um=back.end_um,
        end_um=back.start_um,
        center_um=back.center_um,
        radius_um=back.radius_um,
        start_angle_rad=back.start_angle_rad + back.sweep_rad,
        sweep_rad=-back.sweep_rad,
        length_um=back.length_um,
    )
