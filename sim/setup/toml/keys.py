"""The table of settings: the keys of each section, from which files are read and written, shown and documented.

A section of a file stands in one `Section`, beside the class that it fills. A key that is added to it is read, written,
shown in the settings of ``report.html`` and listed in ``docs/scenarios.md``; its texts stand in
``sim/setup/settings.toml``.

Settings as TOML text.
"""

import json
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal, NamedTuple

from parser.units import mm
from sim.setup.toml.kinds import MM_AS_UM, Number, ValueKind
from sim.setup.toml.reader import number, refuse_unknown, section

REQUIRED: Final = object()
"""In place of a default: the key must be given."""


@dataclass(frozen=True, slots=True)
class Key:
    """One setting.

    Attributes
    ----------
    name
        Its key in the file, with the unit at its end.
    kind
        What its values are.
    field
        Where what the section fills keeps it: an attribute, or with dots one of a part, such as ``limits.jerk_um_s3``
        and ``backlash_um.0``; the name where empty.
    default
        Value where it is left out, as the file would say it, in or out of the bounds; None for no value.
    get
        How it is found in what the section fills, where that is no attribute; None where there is nothing to write.
    option
        The option that takes its place on the command line, such as ``--gap``; empty where there is none.
    older
        Another name of that option, such as one that it had before; empty where there is none.
    form
        The field that takes its place on the page of ``drycut open``; empty where there is none.
    """

    name: str
    kind: ValueKind
    field: str = ""
    default: Any = REQUIRED
    get: Callable[[Any], Any] | None = None
    option: str = ""
    older: str = ""
    form: str = ""

    @property
    def is_required(self) -> bool:
        """Whether it has to be given."""
        return self.default is REQUIRED

    def read(self, table: Mapping[str, Any], where: str) -> Any:
        """Value inside: that of the file or the default. SettingsError names file and key."""
        if self.name in table or self.is_required:
            return self.kind.inside(self.kind.checked(table, self.name, where))
        return None if self.default is None else self.kind.inside(self.default)

    def of_option(self, value: Any) -> Any:
        """What `option` gives, lengths in µm, as it is inside. SettingsError for a number out of bounds."""
        if not isinstance(self.kind, Number):
            return value
        written = mm(value) if self.kind.unit == "mm" else value
        number(written, self.kind.bound, f"{self.option} in {self.kind.unit}")
        return value if self.kind.scale is MM_AS_UM else written

    def written(self, owner: object) -> Any:
        """Value in the file that makes this owner; None where it says nothing, as of a limit that there is not."""
        value = self.get(owner) if self.get else _at(owner, self.path)
        nothing = value is None or (isinstance(value, float) and math.isinf(value))
        return None if nothing else self.kind.written(value)

    @property
    def schema(self) -> dict[str, Any]:
        """JSON schema of its values, with the default where it can stand in a file."""
        is_told = self.default is not None and not self.is_required and self.default not in ((), "")
        is_finite = not (isinstance(self.default, float) and math.isinf(self.default))
        return self.kind.schema() | ({"default": self.default} if is_told and is_finite else {})

    @property
    def path(self) -> str:
        """Where it is kept, with dots."""
        return self.field or self.name


class WrittenSection(NamedTuple):
    """A section as it is written: values as plain Python, by the names of the keys."""

    section: "Section"
    values: Mapping[str, Any]

    @property
    def keys(self) -> tuple[Key, ...]:
        """Keys of the values, in their order."""
        return tuple(key for key in self.section.keys if key.name in self.values)


@dataclass(frozen=True, slots=True)
class Section:
    """A section of a file: its keys in the order in which they are written.

    Attributes
    ----------
    name
        Its name, in the texts and, but for the top of a file, in its header.
    keys
        Its keys.
    fills
        Where the whole that a file makes keeps what the section fills, as a key's field; the whole itself where empty.
    form
        Top of a file, one table, or tables of which there may be many.
    """

    name: str
    keys: tuple[Key, ...]
    fills: str = ""
    form: Literal["top", "table", "list"] = "table"

    @property
    def header(self) -> str:
        """Line above the keys; none at the top of a file."""
        return {"top": "", "table": f"[{self.name}]", "list": f"[[{self.name}]]"}[self.form]

    def read(self, table: Mapping[str, Any], where: str, others: Iterable[str] = ()) -> dict[str, Any]:
        """Values of a table by the fields that keep them, pairs as such; SettingsError names file and key.

        Besides the keys the table may hold those named in `others`.
        """
        refuse_unknown(table, (*(key.name for key in self.keys), *others), where)
        found: dict[str, Any] = {}
        for key in self.keys:
            _put(found, key.path, key.read(table, where))
        return {field: _paired(value) for field, value in found.items()}

    def read_in(self, content: Mapping[str, Any], where: str) -> dict[str, Any]:
        """Values of this section of a file, defaults where it is left out. SettingsError names file and key."""
        return self.read(section(content, self.name, where), f"{where}: {self.header}")

    def written(self, whole: object) -> list[WrittenSection]:
        """The section, or each of its tables, of the file that makes this whole; none where that keeps none."""
        owner = _at(whole, self.fills)
        owners = owner if self.form == "list" else [] if owner is None else [owner]
        return [WrittenSection(self, self._values(owner)) for owner in owners]

    def _values(self, owner: object) -> dict[str, Any]:
        values = {key.name: key.written(owner) for key in self.keys}
        return {name: value for name, value in values.items() if value is not None}


def _at(owner: Any, path: str) -> Any:
    """What an owner keeps at a path with dots; itself where that is empty."""
    for step in filter(None, path.split(".")):
        owner = owner[int(step)] if step.isdigit() else getattr(owner, step)
    return owner


def _put(found: dict[str, Any], path: str, value: Any) -> None:
    """Keep a value at a path with dots, each step but the last a table of its own."""
    *steps, last = path.split(".")
    for step in steps:
        found = found.setdefault(step, {})
    found[last] = value


def _paired(value: Any) -> Any:
    """Values by step, those of steps 0 and 1 as a pair."""
    if not isinstance(value, dict):
        return value
    inner = {step: _paired(entry) for step, entry in value.items()}
    return (inner["0"], inner["1"]) if inner.keys() == {"0", "1"} else inner


def toml_text(sections: Sequence[WrittenSection]) -> str:
    """TOML of sections, the top of the file first; those that hold nothing are left out."""
    return "\n".join(_section(written.section.header, written.values) for written in sections if written.values)


def toml_value(value: Any) -> str:
    """A text, number, truth, list or inline table."""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float) and not math.isfinite(value):
        return "nan" if math.isnan(value) else "inf" if value > 0 else "-inf"
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {toml_value(entry)}" for key, entry in value.items()) + " }"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(map(toml_value, value)) + "]"
    return str(value) if isinstance(value, int | float) else toml_value(str(value))


def _section(header: str, values: Mapping[str, Any]) -> str:
    lines = [f"{_key(key)} = {toml_value(value)}\n" for key, value in values.items()]
    return "".join([f"{header}\n" if header else "", *lines])


def _key(key: str) -> str:
    """A key as it stands, or in quotes where it holds anything but letters, digits, ``_`` and ``-``."""
    bare = key.isascii() and key.replace("_", "a").replace("-", "a").isalnum()
    return key if bare else toml_value(key)
