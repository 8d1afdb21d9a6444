"""The files of a program's last run, kept in its folder with what they were made of; they serve as long as all fit.

``kept.json`` is one file of the set that stands in the folder: it has a digest of all that went into the run, digests
of the other files, and the row of the index. Each is held against what is there: a file that is missing or was changed,
or another program, setting, drawing or version, and the program is run anew.
"""

import hashlib
import json
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from parser.files.reading import read_bytes
from parser.findings.catalogue import Language, Said
from parser.findings.codes import Severity
from parser.findings.errors import FileUnreadableError
from parser.findings.findings import Count
from sim.base.files import staged
from sim.base.workers.makers import Maker
from sim.jobs.index import Row
from sim.setup.scenario import Scenario

NAME: Final = "kept.json"
_SCHEMA: Final = "drycut.kept/1"


def digest_of(program: bytes, scenario: Scenario, drawing: bytes | None, made_by: Maker, language: Language) -> str:
    """Digest of all that the files of a run follow from: nothing of it is a path, so a shop may be moved."""
    settings = replace(
        scenario,
        program=Path(scenario.program.name),
        drawing=scenario.drawing and scenario.drawing._replace(file=Path(scenario.drawing.file.name)),
    )
    told = repr((made_by, language, settings)).encode("utf-8", "surrogatepass")
    parts = (told, program, drawing or b"")
    return _sum(b"".join(_sum(part).encode() for part in parts))


def keep(folder: Path, digest: str, row: Row, files: Mapping[str, bytes], names: frozenset[str]) -> None:
    """Put the files of a run into its folder with what they were made of, all of them or none.

    A file of `names` that the run did not make goes. FileUnreadableError where the folder cannot be written.
    """
    record = {"schema": _SCHEMA, "made_of": digest, "files": {name: _sum(files[name]) for name in sorted(files)}}
    with staged(folder, sorted({*names, *files, NAME})) as stage:
        for name, data in files.items():
            (stage / name).write_bytes(data)
        (stage / NAME).write_text(json.dumps(_sealed({**record, "row": row._asdict()})), "utf-8")


def kept(folder: Path, digest: str) -> Row | None:
    """The row of the run whose files stand in a folder; None where they are not those of this digest, or not whole."""
    try:
        record = json.loads(read_bytes(folder / NAME))
        if record["made_of"] != digest or record != _sealed(record):
            return None
        if any(_sum_of(folder / name) != told for name, told in record["files"].items()):
            return None
        row = record["row"]
        findings = tuple(Count(code, Severity(severity), n) for code, severity, n in row["findings"])
        return Row(**{**row, "findings": findings, "message": Said(*row["message"])})
    except (FileUnreadableError, OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError):
        return None


def drop(folder: Path, names: frozenset[str]) -> None:
    """Take away the files of an earlier run of a program that has none now, and the folder if it is empty then."""
    if folder.is_dir():
        with staged(folder, sorted({*names, NAME})):
            pass
        with suppress(OSError):  # something else is in it
            folder.rmdir()


def _sealed(record: Mapping[str, Any]) -> dict[str, Any]:
    """The record with a digest of itself."""
    bare = {key: value for key, value in record.items() if key != "sum"}
    return {**bare, "sum": _sum(json.dumps(bare).encode())}


def _sum(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def _sum_of(file: Path) -> str:
    """Digest of a file of the set, however large; OSError for what is no file, of which reading might never end."""
    if not file.is_file():
        raise FileNotFoundError(file)
    with file.open("rb") as data:
        return hashlib.file_digest(data, "sha256").hexdigest()
