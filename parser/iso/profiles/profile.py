"""Dialect profiles: what the same text means to one family of controllers, shipped or of a shop's own.

Dialect profiles: what the same text means to one family of controllers, as data in ``parser/iso/profiles``.

Values, their grades and sources: the files themselves, and docs/iso.md §6.

Dialects of a shop's own: a family as a profile has it, changed by a file or by the settings (docs/iso.md §6).

They have the keys of `Profile`, and ``extends``, the profile that they change; each value is held against the type
that its field has there.
"""

import json
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Final, Literal, NoReturn, get_args, get_origin, get_type_hints

from parser.controller_words import CompensationRules
from parser.dialect.reader import ChosenDialect, OwnDialect
from parser.findings.errors import Message, SettingsError, did_you_mean
from parser.text.places import KeyPlaces

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
    angle_integer_deg, angle_point_deg
        Degrees of an angle of 1 without a point, and with one.
    planes
        Which contour of a block of two stands first.
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
    angle_integer_deg: float
    angle_point_deg: float
    planes: Literal["upper-lower", "lower-upper"]
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


_NAME: Final = re.compile(r"[a-z0-9][a-z0-9_-]{0,39}", re.ASCII)
_CODE: Final = re.compile(r"(?:0|[1-9]\d{0,2})(?:\.\d)?", re.ASCII)
"""Number of a G or M word without leading zeros: ``1``, ``90.1``."""
_LETTERS: Final = re.compile(r"[A-Z]*", re.ASCII)
_LONGEST_UM: Final = 1e12
_EXTENDS: Final = "extends"


def own_dialect(name: str, values: Mapping[str, Any], places: KeyPlaces, under: tuple[str, ...] = ()) -> OwnDialect:
    """The dialect of this name that a table says; `places` knows where its keys stand, the table itself `under` some.

    Raises SettingsError with file, line and column for what no profile can have.
    """
    if not _NAME.fullmatch(name):
        raise SettingsError("dialect-name", where=places.of(*under), name=name)
    if name in PROFILES:
        raise SettingsError("dialect-name-taken", where=places.of(*under), name=name)
    base = values.get(_EXTENDS, "common")
    if base not in PROFILES:
        hint = did_you_mean(str(base), PROFILES, Message("known-keys", names=", ".join(PROFILES)))
        raise SettingsError("dialect-extends", where=places.of(*under, _EXTENDS), found=base, hint=hint)
    reading = _Reading(places, under)
    changed = {key: reading.value(key, value) for key, value in values.items() if key != _EXTENDS}
    return OwnDialect(name, base, json.dumps(changed, sort_keys=True))


def own_dialect_text(dialect: OwnDialect) -> str:
    """The file of a dialect: `own_dialect` reads the same of it."""
    changed = {_EXTENDS: dialect.base, **json.loads(dialect.changed)}
    lines = [f"{key} = {json.dumps(value)}" for key, value in changed.items() if not isinstance(value, dict)]
    for section, table in changed.items():
        if isinstance(table, dict):
            lines += ["", f"[{section}]", *(f"{json.dumps(key)} = {json.dumps(value)}" for key, value in table.items())]
    return "\n".join(lines) + "\n"


def own_dialect_schema() -> dict[str, Any]:
    """JSON schema of the table of a dialect."""
    keys = {_EXTENDS: {"enum": list(PROFILES)}, **{key: _schema(of) for key, of in _types().items()}}
    return {"type": "object", "additionalProperties": False, "properties": keys}


@cache
def _types() -> dict[str, Any]:
    """Types of the keys of a profile."""
    hints = get_type_hints(Profile)
    return {key: of for key, of in hints.items() if key != "name"}


@cache
def _effects(letter: str) -> tuple[str, ...]:
    """What words of a letter, ``g`` or ``m``, do in any profile."""
    return tuple(sorted({effect for name in PROFILES for effect in values_of(name)[letter].values()}))


class _Reading:
    """Holds values against their types; complains with the place of the key."""

    def __init__(self, places: KeyPlaces, under: tuple[str, ...]) -> None:
        self._places = places
        self._under = under

    def value(self, key: str, value: object) -> object:
        """The value of a key of a profile."""
        self._known((), key, tuple(_types()))
        if key == "rules":
            hints = get_type_hints(CompensationRules)
            return {name: self._rule(name, of, hints) for name, of in self._table(key, value).items()}
        if key in ("g", "m"):
            return {code: self._effect(key, code, of) for code, of in self._table(key, value).items()}
        if key == "range":
            return {letter: self._range(letter, of) for letter, of in self._table(key, value).items()}
        return self._plain((key,), _types()[key], value)

    def _rule(self, name: str, value: object, hints: Mapping[str, Any]) -> object:
        self._known(("rules",), name, tuple(hints))
        return self._plain(("rules", name), hints[name], value)

    def _effect(self, letter: str, code: str, value: object) -> object:
        if not _CODE.fullmatch(code):
            self._refuse((letter, code), "dialect-code", found=code)
        if value not in _effects(letter):
            self._refuse((letter, code), "dialect-one-of", found=value, words=", ".join(_effects(letter)))
        return value

    def _range(self, letter: str, value: object) -> object:
        if len(letter) != 1 or not _LETTERS.fullmatch(letter):
            self._refuse(("range", letter), "dialect-letters", found=letter)
        if not (isinstance(value, list) and len(value) == 2 and all(map(_is_number, value)) and value[0] <= value[1]):
            self._refuse(("range", letter), "dialect-range", found=value)
        return value

    def _table(self, key: str, value: object) -> Mapping[str, object]:
        if not isinstance(value, Mapping):
            self._refuse((key,), "dialect-table", found=value)
        return value

    def _plain(self, keys: tuple[str, ...], of: Any, value: object) -> object:
        """A value of a plain type: a truth, a length, a word, letters, a list of words or of whole numbers."""
        if of is bool:
            if not isinstance(value, bool):
                self._refuse(keys, "dialect-truth", found=value)
        elif of is float:
            if not _is_number(value) or not 0.0 < value <= _LONGEST_UM:  # type: ignore[operator]
                self._refuse(keys, "dialect-length", found=value)
        elif of is str:
            if not isinstance(value, str) or not _LETTERS.fullmatch(value):
                self._refuse(keys, "dialect-letters", found=value)
        elif get_origin(of) is Literal:
            if value not in get_args(of):
                self._refuse(keys, "dialect-one-of", found=value, words=", ".join(get_args(of)))
        elif not isinstance(value, list) or not all(_is_one(each, get_args(of)[0]) for each in value):
            self._refuse(keys, "dialect-list", found=value, words=", ".join(get_args(get_args(of)[0])) or "1, 2, …")
        return value

    def _known(self, above: tuple[str, ...], key: str, known: tuple[str, ...]) -> None:
        if key not in known:
            hint = did_you_mean(key, known, Message("known-keys", names=", ".join(sorted(known))))
            where = self._places.of(*self._under, *above, key)
            raise SettingsError("unknown-key", where=where, key=key, hint=hint)

    def _refuse(self, keys: tuple[str, ...], code: str, **values: object) -> NoReturn:
        raise SettingsError(code, where=self._places.of(*self._under, *keys), key=".".join(keys), **values)


def _is_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < _LONGEST_UM


def _is_one(value: object, of: Any) -> bool:
    if of is int:
        return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 10_000
    return value in get_args(of)


def _schema(of: Any) -> dict[str, Any]:
    plain: dict[Any, dict[str, Any]] = {
        bool: {"type": "boolean"},
        float: {"type": "number", "exclusiveMinimum": 0, "maximum": _LONGEST_UM},
        str: {"type": "string", "pattern": "^[A-Z]*$"},
        int: {"type": "integer", "minimum": 0, "maximum": 9999},
    }
    if of in plain:
        return plain[of]
    if of is CompensationRules:
        rules = {name: _schema(each) for name, each in get_type_hints(of).items()}
        return {"type": "object", "additionalProperties": False, "properties": rules}
    if get_origin(of) is Literal:
        return {"enum": list(get_args(of))}
    if get_origin(of) is tuple:
        return {"type": "array", "items": _schema(get_args(of)[0])}
    value = get_args(of)[1]
    if value is str:
        return {"type": "object", "additionalProperties": {"type": "string"}}
    pair = {"type": "array", "items": {"type": "number"}, "minItems": 2, "maxItems": 2}
    return {"type": "object", "additionalProperties": pair}
