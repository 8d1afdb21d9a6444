"""Compensation of lines in plain Python, one corner after the other, for programs in which no block vanishes."""

import cmath
import itertools
import math
from typing import NamedTuple

from parser.controller_words import CompensationRules


class Leg(NamedTuple):
    """A line to a place, as a complex number in µm; its offset to the left, None without compensation."""

    to: complex
    left_um: float | None
    is_jump: bool = False


def plain_path(start: complex, legs: list[Leg], rules: CompensationRules) -> list[complex]:
    """The ends of all rows of the path that have length; arcs round corners by their ends alone."""
    places = [start]
    for number in range(len(legs)):
        places += _ends(start, legs, number, rules)
    return [end for before, end in itertools.pairwise(places) if abs(end - before) > 1e-6]


def _ends(start: complex, legs: list[Leg], number: int, rules: CompensationRules) -> list[complex]:
    """Where the path goes in one leg, up to the begin of the next."""
    leg, after = legs[number], legs[number + 1] if number + 1 < len(legs) else None
    if leg.left_um is None:
        return [leg.to]
    u = _way(legs[number - 1].to if number else start, leg.to)
    own = leg.to + leg.left_um * u * 1j
    if after is None or after.left_um is None:
        return [own]
    v = _way(leg.to, after.to)
    if leg.left_um * after.left_um < 0.0:
        return [own, leg.to + after.left_um * v * 1j]
    is_setup = number == 0 or legs[number - 1].left_um is None
    if is_setup and rules.startup == "next-normal":
        return [leg.to + leg.left_um * v * 1j]
    return _corner(leg, after, u, v, rules.outer)


def _corner(leg: Leg, after: Leg, u: complex, v: complex, outer: str) -> list[complex]:
    d = leg.left_um
    turn = cmath.phase(v / u)
    if turn * d > 0.0 or (outer != "arc" and abs(turn) <= 0.5 * math.pi):
        return [leg.to + d * 1j * (u + v) / (1.0 + math.cos(turn))]
    one, other = leg.to + d * 1j * u, leg.to + d * 1j * v
    if leg.is_jump:
        return [other]
    if after.is_jump:
        return [one]
    return [one + abs(d) * u, other - abs(d) * v] if outer == "chamfer" else [one, other]


def _way(a: complex, b: complex) -> complex:
    return (b - a) / abs(b - a)
