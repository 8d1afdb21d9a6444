"""A settings file, read strictly: ``drycut.toml``, or ``[tool.drycut]`` of ``pyproject.toml``; and its JSON schema.

Patterns for paths, with the meaning that they have in the settings of ruff: ``*`` goes past slashes.

A pattern is held against the name of a file or folder alone, and against its path below the folder of the pattern.

JSON schema of ``drycut.toml``, for editors that complete and check TOML.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fnmatch import translate
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, NamedTuple, get_args

from parser.dialect.reader import ChosenDialect, Marks, OwnDialect
from parser.findings.codes import CODES
from parser.findings.errors import SettingsError
from parser.program import block_words, own_dialect_schema, own_marks
from sim.check.result import FailOn
from sim.check.settings.model import WIRE_LENGTHS, CheckSettings
from sim.setup.dialect import READ_WITH, REGISTERS, UNIT, chosen_dialect, own_dialects_of
from sim.setup.key_tables import DRAFT
from sim.setup.part import MATERIAL, THICKNESS
from sim.setup.toml.kinds import pair_schema
from sim.setup.toml.reader import PLACE_MM, load_toml, pair, refuse_unknown, section, text, truth

if TYPE_CHECKING:
    from sim.setup.machine.machine import Machine
    from sim.setup.technology import Technology


_PIECE = re.compile(r"(?:(?<=/)|\A)\*\*/|\*+|\[!?\]?[^\]]*\]|.", re.DOTALL)
_CLOSED = 2
"""Characters with which `fnmatch.translate` closes an expression."""


class PathPattern(NamedTuple):
    """A pattern as it was written, and the folder that its paths begin in; that has no link in it."""

    text: str
    folder: Path

    def matches(self, path: Path) -> bool:
        """Whether a path, which has no link in it but for its last part, is meant."""
        pattern = _compiled(self.text.removeprefix("./").rstrip("/"))
        if pattern.fullmatch(path.name) or pattern.fullmatch(path.as_posix()):
            return True
        below = path.is_relative_to(self.folder)
        return below and pattern.fullmatch(path.relative_to(self.folder).as_posix()) is not None


def pattern_list(value: object, folder: Path, where: str) -> tuple[PathPattern, ...]:
    """Patterns of a list of texts. SettingsError where it is none, or where one is empty."""
    if not isinstance(value, list) or not all(isinstance(text, str) and text.strip("./") for text in value):
        raise SettingsError("no-list-of-patterns", where=where, found=value)
    return tuple(PathPattern(text, folder) for text in value)


@cache
def _compiled(text: str) -> re.Pattern[str]:
    """Regular expression of a pattern: ``*`` and ``?`` mean any characters, ``**/`` any folders, ``[…]`` one of some.

    What stands between two stars is taken where it comes first: elsewhere it would leave less for the rest. So no
    pattern takes long.
    """
    pieces = [""]
    for match in _PIECE.finditer(text):
        piece = match[0]
        if piece.startswith("*"):
            pieces.append("(?:.*?/)??" if piece.endswith("/") else ".*?")
        else:
            pieces[-1] += translate(piece)[:-_CLOSED]
    first, *rest = pieces
    closed = [f"(?>{piece})" for piece in rest[:-1]]
    return re.compile("".join([first, *closed, *rest[-1:]]), re.DOTALL)


NAMES = ("drycut.toml", "pyproject.toml")
"""Names of settings files; in one folder the first goes first."""
_PROJECT = NAMES[1]
_TOOL = ("tool", "drycut")
"""Tables of the second under which its settings stand."""
KEYS = (
    *(
        "root",
        "machine",
        "machines",
        "technology",
        "material",
        "thickness_mm",
        "start_mm",
        "open",
        "select",
        "ignore",
        "fail_on",
        "exclude",
        "include",
        "baseline",
        "help_uri",
    ),
    *(key.name for key in READ_WITH),
    *("end_marks", "pause_marks", "dialects", "wire", "per_file_ignores"),
)
"""Keys of a settings file, in the order of docs/check.md."""
_HELP_URI: Final = r"^https?://[-A-Za-z0-9._~:/?#\[\]@!$&'()*+,;=%]+\{code\}[-A-Za-z0-9._~:/?#\[\]@!$&'()*+,;=%]*$"
"""What RFC 3986 allows in an address, with the place of the code."""
FAIL_ON: tuple[FailOn, ...] = get_args(FailOn)
_WIRE = {key.name: key for key in WIRE_LENGTHS.values()}


class IgnoredOf(NamedTuple):
    """Beginnings of codes that are not shown of the files of a pattern."""

    pattern: PathPattern
    codes: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class SettingsFile:
    """What a settings file says.

    Attributes
    ----------
    settings
        What all its files are checked with.
    per_file_ignores
        Codes that are not shown of some files.
    exclude
        Files and folders that are left out where a folder is looked through.
    include
        Files that are checked there though their names do not end as those of programs do.
    baseline
        File of known findings; None where it names none.
    dialects
        Dialects of a shop's own, by their names.
    machines
        Folder of a shop's machine files; None where it names none.
    help_uri
        Address of the page of a finding, with ``{code}`` for its code; empty where a shop has no such pages.
    """

    settings: CheckSettings = CheckSettings()  # noqa: RUF009 - frozen
    per_file_ignores: tuple[IgnoredOf, ...] = ()
    exclude: tuple[PathPattern, ...] = ()
    include: tuple[PathPattern, ...] = ()
    baseline: Path | None = None
    dialects: Mapping[str, OwnDialect] = field(default_factory=dict)
    machines: Path | None = None
    help_uri: str = ""

    def settings_of(self, path: Path) -> CheckSettings:
        """What one file is checked with; its path has no link in it but for its last part."""
        codes = [code for ignored in self.per_file_ignores if ignored.pattern.matches(path) for code in ignored.codes]
        return replace(self.settings, ignore_here=tuple(codes)) if codes else self.settings


NO_SETTINGS = SettingsFile()


def content_of(file: Path) -> Mapping[str, Any] | None:
    """What a settings file holds for drycut; None for a ``pyproject.toml`` without ``[tool.drycut]``.

    Raises FileUnreadableError or SettingsError.
    """
    content = load_toml(file)
    if file.name != _PROJECT:
        return content
    tool, drycut = _TOOL
    tools = section(content, tool, str(file))
    return section(tools, drycut, str(file)) if drycut in tools else None


def read_settings(content: Mapping[str, Any], file: Path, name: str) -> SettingsFile:
    """Settings of a file, of which the path has no link in it; it is named `name` to people.

    Raises FileUnreadableError or SettingsError with file and key.
    """
    refuse_unknown(content, KEYS, name)
    truth(content, "root", name)
    wire = section(content, "wire", name)
    refuse_unknown(wire, _WIRE, f"{name}: [wire]")
    lengths = {
        field: _WIRE[key.name].read(wire, f"{name}: [wire]") for field, key in WIRE_LENGTHS.items() if key.name in wire
    }
    own = own_dialects_of(content, file, name, _TOOL if file.name == _PROJECT else ())
    machines = _machines(content, file, name)
    dialect = _dialect(content, own, file, name)
    settings = CheckSettings(
        dialect=dialect,
        machine=_machine(content, file, machines, name),
        technology=_technology(content, file, name),
        material=MATERIAL.read(content, name),
        thickness_mm=THICKNESS.read(content, name) if THICKNESS.name in content else None,
        start_mm=pair(content, "start_mm", name),
        may_stay_open=truth(content, "open", name),
        select=code_list(content.get("select", []), f"{name}: select"),
        ignore=code_list(content.get("ignore", []), f"{name}: ignore"),
        fail_on=mildest_failing(content.get("fail_on", "incomplete"), f"{name}: fail_on"),
        marks=_marks(content, name),
        **lengths,
        **{key.path: key.read(content, name) for key in (UNIT, REGISTERS)},
        file=name,
    )
    return SettingsFile(
        settings,
        _per_file_ignores(content, file.parent, name),
        pattern_list(content.get("exclude", []), file.parent, f"{name}: exclude"),
        pattern_list(content.get("include", []), file.parent, f"{name}: include"),
        file.parent / text(content, "baseline", name) if "baseline" in content else None,
        own,
        machines,
        _help_uri(content, name),
    )


def _machines(content: Mapping[str, Any], file: Path, where: str) -> Path | None:
    """The folder of a shop's machine files; None where it names none. SettingsError where it is no folder."""
    if "machines" not in content:
        return None
    folder = file.parent / text(content, "machines", where)
    if not folder.is_dir():
        raise SettingsError("no-machines-folder", where=where, folder=folder)
    return folder


def _help_uri(content: Mapping[str, Any], where: str) -> str:
    """The address of pages of findings; empty where there is none. SettingsError for what is no such address."""
    if "help_uri" not in content:
        return ""
    address = text(content, "help_uri", where)
    if not re.fullmatch(_HELP_URI, address):
        raise SettingsError("no-help-uri", where=where, found=address)
    return address


def _dialect(content: Mapping[str, Any], own: Mapping[str, OwnDialect], file: Path, where: str) -> ChosenDialect:
    """The dialect that a settings file chooses: one that it defines, one of a file, or a profile."""
    if "dialect" not in content:
        return ""
    return chosen_dialect(text(content, "dialect", where), file.parent, own, where)


def code_list(value: object, where: str) -> tuple[str, ...]:
    """Codes or their beginnings, such as ``3B2``. SettingsError for one that no code begins with."""
    if not isinstance(value, list) or not all(isinstance(code, str) for code in value):
        raise SettingsError("no-list-of-codes", where=where, found=value)
    codes = tuple(code.strip().upper() for code in value if code.strip())
    if not all(map(_is_known, codes)):
        from sim.check.own_checks import load_own_checks  # noqa: PLC0415 - most codes are those of drycut

        load_own_checks()
    for code in codes:
        if not _is_known(code):
            raise SettingsError("no-such-code", where=where, code=code, codes=_first_last())
    return codes


def _is_known(code: str) -> bool:
    return any(known.startswith(code) for known in CODES)


def mildest_failing(value: object, where: str) -> FailOn:
    """The mildest that fails a file. SettingsError for what is none of those."""
    for known in FAIL_ON:
        if value == known:
            return known
    raise SettingsError("no-severity", where=where, found=value)


def _per_file_ignores(content: Mapping[str, Any], folder: Path, where: str) -> tuple[IgnoredOf, ...]:
    ignored = []
    for key, value in section(content, "per_file_ignores", where).items():
        here = f"{where}: [per_file_ignores]"
        (pattern,) = pattern_list([key], folder, here)
        ignored.append(IgnoredOf(pattern, code_list(value, f"{here}: {key}")))
    return tuple(ignored)


def _machine(content: Mapping[str, Any], file: Path, machines: Path | None, where: str) -> "Machine | None":
    name = content.get("machine")
    if name is None:
        return None
    if not isinstance(name, str):
        raise SettingsError("no-machine-name", where=where, found=name)
    from sim.setup.machine.machine import load_machine  # noqa: PLC0415 - most checks know no machine

    return load_machine(name, file.parent, machines)


def _technology(content: Mapping[str, Any], file: Path, where: str) -> "Technology | None":
    if "technology" not in content:
        return None
    from sim.setup.technology import load_technology  # noqa: PLC0415 - most checks know no technology

    return load_technology(file.parent / text(content, "technology", where))


def _marks(content: Mapping[str, Any], where: str) -> Marks:
    """Marks that neither are a word of blocks nor mean two things at once."""
    own, of_blocks = own_marks(), block_words()
    end, pause = _words(content, "end_marks", where), _words(content, "pause_marks", where)
    for key, words, other in (("end_marks", end, (*own.pause, *pause)), ("pause_marks", pause, (*own.end, *end))):
        for word in words:
            if word in of_blocks:
                raise SettingsError("mark-is-a-block-word", where=where, key=key, word=word)
            if word in other:
                raise SettingsError("mark-ends-and-pauses", where=where, key=key, word=word)
    return Marks(end, pause)


def _words(content: Mapping[str, Any], key: str, where: str) -> tuple[str, ...]:
    """Marks: words of one to four letters."""
    words = content.get(key, [])
    if not isinstance(words, list) or not all(
        isinstance(word, str) and word.isascii() and word.isalpha() and len(word) <= 4 for word in words
    ):
        raise SettingsError("no-list-of-marks", where=where, key=key, found=words)
    return tuple(word.upper() for word in words)


def _first_last() -> str:
    codes = sorted(CODES)
    return f"{codes[0]} to {codes[-1]}"


_TEXT: Final = {"type": "string", "minLength": 1}
_CODES: Final = {"type": "array", "items": {"type": "string"}}
_ADDRESS: Final = {"type": "string", "pattern": _HELP_URI}
_MARKS: Final = {"type": "array", "items": {"type": "string", "pattern": "^[A-Za-z]{0,4}$"}}


def settings_schema() -> dict[str, Any]:
    """JSON schema of ``drycut.toml``, which is that of ``[tool.drycut]`` in ``pyproject.toml``, too."""
    wire = _table({key.name: key.schema for key in WIRE_LENGTHS.values()})
    keys: dict[str, tuple[str, dict[str, Any]]] = {
        "root": ("the search for settings ends here", {"type": "boolean"}),
        "machine": ("name of a machine, or its .toml file", {"type": "string"}),
        "machines": ("folder of machine files, whose names count before those that come with drycut", _TEXT),
        "technology": ("technology file: what the wire does, pass by pass", _TEXT),
        "material": ("material of the work, one that the technology knows", MATERIAL.schema),
        "thickness_mm": ("thickness of the work", THICKNESS.kind.schema()),
        "start_mm": ("place of the program's start on the table", pair_schema(PLACE_MM)),
        "open": ("contours may stay open", {"type": "boolean"}),
        "select": ("codes of findings that are shown, or their beginnings", _CODES),
        "ignore": ("codes of findings that are not shown, or their beginnings", _CODES),
        "fail_on": ("the mildest that fails: errors; also incomplete checks; also warnings", {"enum": list(FAIL_ON)}),
        "exclude": ("patterns of files that are left out where a folder is looked through", _list_of(_TEXT)),
        "include": ("patterns of files that are programs whatever their names end in", _list_of(_TEXT)),
        "baseline": ("file of known findings and incomplete checks", _TEXT),
        "help_uri": (
            "address of the page of a finding, {code} its code: helpUri of SARIF",
            _ADDRESS,
        ),
        "dialect": ("dialect of ISO programs, also one of those below, or its .toml file", _TEXT),
        **{key.name: (f"{key.name} of ISO programs", key.schema) for key in (UNIT, REGISTERS)},
        "end_marks": ("more words for the end of a program", _MARKS),
        "pause_marks": ("more words for a pause in a program", _MARKS),
        "wire": (
            "wire that corners and offsets are held against",
            wire,
        ),
        "dialects": (
            "dialects of a shop's own by their names, or their files",
            {"type": "object", "additionalProperties": {"oneOf": [_TEXT, own_dialect_schema()]}},
        ),
        "per_file_ignores": (
            "codes that are not shown of the files of a pattern",
            {"type": "object", "additionalProperties": _CODES},
        ),
    }
    properties = {name: {"description": meaning, **schema} for name, (meaning, schema) in keys.items()}
    return {"$schema": DRAFT, "title": "drycut.toml (docs/check.md)", **_table(properties)}


def _table(properties: dict[str, Any]) -> dict[str, Any]:
    return {"type": "object", "additionalProperties": False, "properties": properties}


def _list_of(entry: dict[str, Any]) -> dict[str, Any]:
    return {"type": "array", "items": entry}
