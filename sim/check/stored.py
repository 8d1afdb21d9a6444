"""Results that stay in a folder: of files in which nothing was found, and that need no check while they stand so.

A result is known by a digest of all that it follows from: the bytes and the name of the file, the settings that count
for it, and what its baseline knows. The whole is sealed with what checks, down to drycut's own sources. A file with
findings is checked anew every time: it is worked on, and what is said of it comes from the check alone. Where the
folder cannot be read, or its file is damaged or of another drycut, all files are checked.
"""

import hashlib
import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final, NamedTuple, get_args

from parser.dialect.reader import Assumption
from parser.files import read_bytes
from parser.findings.errors import FileUnreadableError
from parser.toolpath import Point
from sim.base.files.stages import staged
from sim.base.workers.maker import made_by
from sim.check.file_check import Job
from sim.check.files import STORED
from sim.check.result import CheckResult, CheckState, Coverage, Programmed, Silenced, State

_IGNORE: Final = ".gitignore"
_SCHEMA: Final = "drycut.check-cache/1"
_MOST: Final = 50_000
"""Results that the file holds, those of the last check first: some 50 MB."""
_ROOM: Final = 64 * 2**20
"""Bytes of programs that wait for their check; those beyond are checked from their files, and not stored."""

Record = dict[str, Any]


class _Look(NamedTuple):
    """A job, with its bytes where they were read, and what is known of its result.

    `key` is the digest that the result is known by, empty where it is not to be stored; `result` is the stored one.
    """

    job: Job
    key: str = ""
    result: CheckResult | None = None


def with_stored(
    jobs: Sequence[Job],
    folder: Path,
    check: Callable[[Sequence[Job]], Iterable[CheckResult]],
    refused: Callable[[FileUnreadableError], None],
) -> Iterator[CheckResult]:
    """Results in the order of the jobs: those that a folder holds, and of all others what `check` gives.

    Afterwards the folder holds the results of all files in which nothing was found. Where it cannot be written, that is
    `refused`, and the results are what they are.
    """
    records = _read(folder / STORED)
    looks = list(_looks(jobs, records))
    fresh = iter(check([look.job for look in looks if look.result is None]))
    passed: dict[str, Record] = {}
    for look in looks:
        result = look.result or next(fresh)
        if look.key and _is_silent(result):
            passed[look.key] = record_of(result)
        yield result
    try:
        _write(folder, passed | {key: record for key, record in records.items() if key not in passed})
    except FileUnreadableError as error:
        refused(error)


def _looks(jobs: Iterable[Job], records: Mapping[str, Record]) -> Iterator[_Look]:
    room = _ROOM
    for job in jobs:
        try:
            data = job.source if isinstance(job.source, bytes) else read_bytes(job.source)
        except FileUnreadableError:
            yield _Look(job)
            continue
        key = _key(job, data)
        if (result := _result(records.get(key), job)) is not None:
            yield _Look(job, key, result)
        elif (room := room - len(data)) >= 0:
            yield _Look(job._replace(source=data), key)
        else:
            yield _Look(job)


def _key(job: Job, data: bytes) -> str:
    """Digest of all that the result of a job follows from, but for what checks it."""
    settings = replace(job.settings, by_options=frozenset())  # sets have no order of their own
    text = repr((job.name, settings, sorted(job.settings.by_options), sorted(job.known)))
    return hashlib.sha256(text.encode("utf-8", "surrogatepass") + b"\0" + hashlib.sha256(data).digest()).hexdigest()


def _is_silent(result: CheckResult) -> bool:
    """Whether there is nothing to say of a file but that it was read and checked."""
    return not (result.findings or result.unreadable or result.fault)


def record_of(result: CheckResult) -> Record:
    """What is stored of a result that is silent; what its job says is left out."""
    return {
        "encoding": result.encoding,
        "dialect": result.dialect,
        "blocks": result.coverage[:4],
        "checks": result.coverage.checks,
        "length_um": result.length_um,
        "steps": result.steps,
        "silenced": result.silenced,
        "assumptions": result.assumptions,
        "programmed": result.programmed,
    }


def _result(record: Record | None, job: Job) -> CheckResult | None:
    """The result of a job from its record; None where there is none, or it is not as `record_of` makes it."""
    if record is None:
        return None
    try:
        return CheckResult(
            name=job.name,
            encoding=str(record["encoding"]),
            dialect=str(record["dialect"]),
            findings=(),
            excerpts={},
            coverage=_coverage(record["blocks"], record["checks"]),
            length_um=float(record["length_um"]),
            steps=int(record["steps"]),
            fail_on=job.settings.fail_on,
            settings_file=job.settings.file,
            silenced=_silenced(record["silenced"]),
            assumptions=tuple(Assumption(*map(str, each)) for each in record["assumptions"]),
            programmed=_programmed(record["programmed"]),
        )
    except (LookupError, TypeError, ValueError, OverflowError):
        return None


def _silenced(listed: Sequence[Any]) -> Silenced:
    options, settings, remarks, baseline, checks = map(int, listed)
    return Silenced(options, settings, remarks, baseline, checks)


def _coverage(blocks: Sequence[Any], checks: Sequence[Any]) -> Coverage:
    found, read, decoded, stepped = map(int, blocks)
    return Coverage(found, read, decoded, stepped, tuple(map(_state, checks)))


def _state(listed: Sequence[Any]) -> CheckState:
    name, state, reason, words = listed
    if state not in get_args(State):
        raise ValueError(state)
    return CheckState(str(name), state, str(reason), tuple(map(str, words)))


def _programmed(listed: Sequence[Any] | None) -> Programmed | None:
    if listed is None:
        return None
    lines, arcs, rapids, cut_length_um, box_um, first_um, last_um = listed
    x0, y0, x1, y1 = map(float, box_um or (0, 0, 0, 0))
    return Programmed(
        int(lines),
        int(arcs),
        int(rapids),
        float(cut_length_um),
        None if box_um is None else (x0, y0, x1, y1),
        *(None if place is None else Point(*map(float, place)) for place in (first_um, last_um)),
    )


def _read(file: Path) -> dict[str, Record]:
    """The records of a folder's file; none where it is not whole, or another drycut wrote it."""
    try:
        sealed, _, body = read_bytes(file).partition(b"\n")
        if sealed.decode() != seal(body):
            return {}
        records = json.loads(body)
        return records if isinstance(records, dict) else {}
    except (FileUnreadableError, ValueError, RecursionError):
        return {}


def _write(folder: Path, records: Mapping[str, Record]) -> None:
    """FileUnreadableError where it cannot be done."""
    body = json.dumps(dict(list(records.items())[:_MOST]), separators=(",", ":")).encode()
    ignore = {} if folder.exists() else {_IGNORE: b"*\n"}  # a folder of results is nobody's source
    files = {STORED: seal(body).encode() + b"\n" + body, **ignore}
    with staged(folder, list(files)) as stage:
        for name, data in files.items():
            (stage / name).write_bytes(data)


def seal(body: bytes) -> str:
    """Digest of the records and of what made them."""
    return hashlib.sha256(repr((_SCHEMA, made_by())).encode() + b"\n" + body).hexdigest()
