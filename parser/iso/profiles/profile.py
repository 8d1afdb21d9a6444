"""Dialect profiles: what the same text means to one family of controllers, as data in ``parser/iso/profiles``.

Values, their grades and sources: the files themselves, and docs/iso.md §6.
"""

import json
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Literal

from parser.controller_words.compensation import CompensationRules
from parser.dialect.choices import ChosenDialect, OwnDialect

_FOLDER = Path(__file__).parent
PROFILES = (
    "fast-wire",
    "classroom",
    "skd2",
    "robofil",
    "sodick",
    "mitsubishi",
    "fanuc",
    "patent-mill",
    "common",
    "strict",
)
"""Names of all profiles, as ``--dialect`` takes them."""


@dataclass(frozen=True, slots=True)
class Profile:
    """One family of controllers.

    Attributes
    ----------
    name
        As ``--dialect`` takes it.
    integer_um, point_um
        µm of a number of 1 without a point, and with one.
    resolution_um
        Least step that coordinates are written in: the tolerance of arcs follows from it.
    step_um
        Least step of the machine, to which it rounds finer numbers.
    may_be_inch
        Whether programs of the family are written in mm or in inches, and do not say in which.
    distance
        Mode at the start: ``absolute`` as after G90, ``incremental`` as after G91.
    centers
        I J: ``from-start`` of the arc, or ``absolute`` places.
    register_integer_um, register_point_um
        The same as for coordinates, of values that offset registers are set to.
    offset_letters
        Letters that select a register of an offset: ``D``, ``H``.
    needs_offset_word
        Whether G41 without a register is an error of the controller.
    zero_register_is_off
        Whether register 0 is always 0.
    calls
        What P of a call names, in the order in which it is looked for: ``beginning``, the N at which a subprogram
        behind the end of the program begins; ``program``, an O; ``number``, any N, first those behind the end.
    repeats_in_call
        Whether digits of P before its last four are how often the subprogram runs.
    programs_end_at_o
        Whether a program ends where the next one begins with its O.
    strict_order
        Whether words in another order than the rule's are an error.
    letters
        Letters of words that it knows.
    repeatable
        Letters of words that may stand in a block more than once.
    meant_twice
        Numbers of M words that are written twice on purpose.
    angle
        Letter of the angle by which the wire leans.
    whole
        Letters of words whose numbers are whole.
    range
        Least and greatest number of a word as written, by letters; lengths have bounds of their own.
    most_coordinate_um, most_radius_um
        Greatest length either way: of coordinates, and of radii and the ways to centres.
    g, m
        What G and M words do, by their numbers as written without leading zeros (``"1"``, ``"90.1"``).
    rules
        How it compensates.
    """

    name: str
    integer_um: float
    point_um: float
    resolution_um: float
    step_um: float
    may_be_inch: bool
    distance: Literal["absolute", "incremental"]
    centers: Literal["from-start", "absolute"]
    register_integer_um: float
    register_point_um: float
    offset_letters: str
    needs_offset_word: bool
    zero_register_is_off: bool
    calls: tuple[Literal["beginning", "program", "number"], ...]
    repeats_in_call: bool
    programs_end_at_o: bool
    strict_order: bool
    letters: str
    repeatable: str
    meant_twice: tuple[int, ...]
    angle: str
    whole: str
    range: Mapping[str, tuple[float, float]]
    most_coordinate_um: float
    most_radius_um: float
    g: Mapping[str, str]
    m: Mapping[str, str]
    rules: CompensationRules


@cache
def profile(dialect: ChosenDialect) -> Profile:
    """The profile of a dialect: its own values over those that it extends. KeyError where there is none."""
    values = values_of(dialect)
    rules = CompensationRules(**values.pop("rules"))
    limits = {letter: (float(low), float(high)) for letter, (low, high) in values.pop("range").items()}
    twice, calls = tuple(values.pop("meant_twice")), tuple(values.pop("calls"))
    return Profile(name=str(dialect), rules=rules, range=limits, meant_twice=twice, calls=calls, **values)


def values_of(dialect: ChosenDialect) -> dict[str, Any]:
    """The values of a dialect: its own over those of the profile that it extends, those over ``common``."""
    if isinstance(dialect, OwnDialect):
        return _over(values_of(dialect.base), json.loads(dialect.changed))
    if dialect not in PROFILES:
        raise KeyError(dialect)
    values = _read("common")
    return values if dialect == "common" else _over(values, _read(dialect))


def _over(values: dict[str, Any], own: dict[str, Any]) -> dict[str, Any]:
    return {**values, **{key: {**values[key], **of} if isinstance(of, dict) else of for key, of in own.items()}}


def _read(name: str) -> dict[str, Any]:
    return tomllib.loads((_FOLDER / f"{name}.toml").read_text(encoding="utf-8"))
