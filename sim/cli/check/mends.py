"""``--fix`` and ``--diff``: what is certain, mended in all files of a run, or shown.

Certain mends written into a program file: nothing else in it changes.

What a mend changes in a file, as a unified diff: for people, and byte for byte for ``patch`` and ``git apply``.
"""

import os
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from itertools import groupby, takewhile
from pathlib import Path, PurePath
from typing import AnyStr, Generic, NamedTuple

from parser.files import read_bytes
from parser.findings.catalogue import Language
from parser.findings.errors import FileUnreadableError, ProgramError
from parser.findings.findings import Finding
from parser.program import Program, load_program
from parser.text.encoding import printable
from parser.text.places import place
from parser.text.source import LINE_END
from sim.base.files import replace_file, staged
from sim.check.file_check import Job, mended_text
from sim.check.fixes import Choice, choices
from sim.check.settings import CheckSettings
from sim.cli.scenario_options import describe
from sim.show.terminal.printer import say, write, write_exactly
from sim.show.terminal.streams import outlet
from sim.show.terminal.wrap import width_of, wrapped
from sim.show.texts import Words

_CONTEXT = 3  # lines around a change that stay the same, as diff -u has them
_LINE = re.compile(rb"[^\n]*\n|[^\n]+")  # patch and git end a line at a line feed, whatever the file's encoding
_QUOTED = re.compile(rb'[\x00-\x1f"\\\x7f]')  # characters in names for which git writes escapes, in quotes


class _Change(NamedTuple):
    """Lines `first` up to but without `past` become lines `first` up to but without `new_past`, from 0."""

    first: int
    past: int
    new_past: int


class _Hunk(NamedTuple, Generic[AnyStr]):
    """Head of a hunk, and its lines with their signs."""

    head: str
    rows: list[tuple[str, AnyStr]]


def for_people(name: str, before: str, after: str) -> str:
    """Unified diff of two texts: line ends of any kind as newlines, other control characters as U+FFFD.

    Empty where they are the same.
    """
    lines: list[str] = []
    for head, rows in _hunks(_shown_lines(before), _shown_lines(after)):
        lines += (head, *(sign + line for sign, line in rows))
    heads = (f"--- {printable(name)}", f"+++ {printable(name)}") if lines else ()
    return "".join(f"{line}\n" for line in (*heads, *lines))


def for_tools(name: str, before: bytes, after: bytes) -> bytes:
    """Unified diff of two contents, of which ``patch -p0`` and ``git apply -p0`` make the second from the first.

    Empty where they are the same.
    """
    parts: list[bytes] = []
    for head, rows in _hunks(_LINE.findall(before), _LINE.findall(after)):
        parts.append(head.encode() + b"\n")
        parts += (sign.encode() + _ended(line) for sign, line in rows)
    heads = [b"--- " + _name(name) + b"\n", b"+++ " + _name(name) + b"\n"] if parts else []
    return b"".join(heads + parts)


def _shown_lines(text: str) -> list[str]:
    lines = [printable(line) for line in LINE_END.split(text)]
    return lines if lines[-1] else lines[:-1]


def _ended(line: bytes) -> bytes:
    return line if line.endswith(b"\n") else line + b"\n\\ No newline at end of file\n"


def _name(name: str) -> bytes:
    """Name of a file as both tools read it: from the folder of the run where it lies below, as they refuse others."""
    path = PurePath(name)
    if path.is_relative_to(Path.cwd()):
        path = path.relative_to(Path.cwd())
    raw = os.fsencode(path.as_posix())
    if _QUOTED.search(raw):
        return b'"' + _QUOTED.sub(lambda found: b"\\%03o" % ord(found[0]), raw) + b'"'
    return raw + b"\t" if b" " in raw else raw  # what follows a blank would be a date, but for the tab


def _hunks(before: Sequence[AnyStr], after: Sequence[AnyStr]) -> Iterator[_Hunk[AnyStr]]:
    for changes in _near(_changes(before, after)):
        first, past = max(changes[0].first - _CONTEXT, 0), min(changes[-1].past + _CONTEXT, len(before))
        new_past = changes[-1].new_past + past - changes[-1].past
        rows: list[tuple[str, AnyStr]] = []
        at = first
        for change in changes:
            rows += ((" ", line) for line in before[at : change.first])
            rows += (("-", line) for line in before[change.first : change.past])
            rows += (("+", line) for line in after[change.first : change.new_past])
            at = change.past
        rows += ((" ", line) for line in before[at:past])
        yield _Hunk(f"@@ -{_range(first, past)} +{_range(first, new_past)} @@", rows)


def _range(first: int, past: int) -> str:
    """Lines in the head of a hunk: the first from 1, and how many; where there are none, the line before."""
    return f"{first + (past > first)},{past - first}"


def _changes(before: Sequence[AnyStr], after: Sequence[AnyStr]) -> Iterator[_Change]:
    """Lines that differ, each held against the one in its place: linear, where a search for the shortest diff is not.

    That is enough: a mend changes words within their lines, and adds lines only behind all that it changes. Those have
    their place before the lines that both end with.
    """
    tail = sum(1 for _ in takewhile(lambda at: before[~at] == after[~at], range(min(len(before), len(after)))))
    old, new = len(before) - tail, len(after) - tail
    places = range(max(old, new))
    for differ, group in groupby(places, lambda at: at >= min(old, new) or before[at] != after[at]):
        if differ:
            first, *rest = group
            past = first + 1 + len(rest)
            yield _Change(first, min(past, old), min(past, new))


def _near(changes: Iterator[_Change]) -> Iterator[list[_Change]]:
    """Changes whose contexts touch, together."""
    near: list[_Change] = []
    for change in changes:
        if near and change.first - near[-1].past > 2 * _CONTEXT:
            yield near
            near = []
        near.append(change)
    if near:
        yield near


class Unmended(NamedTuple):
    """A finding with several possible mends, none of which was made; as they would stand in the program."""

    finding: Finding
    choices: tuple[Choice, ...]


class Mended(NamedTuple):
    """A program with all that is certain mended, as text and as content; and what is left for a person to decide."""

    program: Program
    before: bytes
    text: str
    after: bytes
    unmended: tuple[Unmended, ...]

    @property
    def changed(self) -> bool:
        """Whether anything was mended."""
        return self.text != self.program.text

    @property
    def diff(self) -> str:
        """What was mended, for people; empty where nothing was."""
        return for_people(self.program.name, self.program.text, self.text)

    @property
    def patch(self) -> bytes:
        """What was mended, for ``patch`` and ``git apply``; empty where nothing was."""
        return for_tools(self.program.name, self.before, self.after)


def mended(path: Path, name: str, settings: CheckSettings, known: frozenset[str] = frozenset()) -> Mended:
    """Mend what is certain, keeping encoding, line ends and all else; nothing where a mend would bring a new error.

    What settings, remarks or the baseline, of which the fingerprints are `known`, silence is not mended. Raises
    ProgramError or FileUnreadableError for a file that cannot be read.
    """
    before = read_bytes(path)
    program = load_program(before, name, settings.choices)
    mend = mended_text(program, settings, known)
    possible = ((finding, choices(program, finding, mend.findings)) for finding in mend.listed)
    unmended = tuple(Unmended(finding, ways) for finding, ways in possible if len(ways) > 1)
    after = mend.data if mend.text != program.text else before
    return Mended(program, before, mend.text, after, unmended)


def fix_file(path: Path, name: str, settings: CheckSettings, known: frozenset[str] = frozenset()) -> Mended | None:
    """Write into the file what `mended` makes of it. None for a file that cannot be read, which stays as it is.

    Raises FileUnreadableError where the file cannot be written; then it is as it was.
    """
    try:
        mend = mended(path, name, settings, known)
    except (ProgramError, FileUnreadableError):
        return None
    if mend.changed:
        replace_file(path, mend.before, mend.after)
    return mend


def unmended_text(mend: Mended, language: Language, width: int) -> str:
    """What was not mended, as there is more than one way to do it; for people, the mends in lines of `width` cells."""
    return "".join(
        f"{line}\n" for unmended in mend.unmended for line in _unmended_lines(mend.program, unmended, language, width)
    )


def _unmended_lines(program: Program, unmended: Unmended, language: Language, width: int) -> list[str]:
    say, finding, names = Words(language), unmended.finding, program.toolpath.source.names
    where = place(printable(program.name), finding.line, finding.column)
    choices = (say("findings.choice", block=names(choice.block), text=choice.text) for choice in unmended.choices)
    return [
        say("findings.left", place=where, code=finding.code),
        *wrapped(say("findings.or").join(choices), width, head="    "),
    ]


_Put = Callable[[Mended], object]


def fix_files(jobs: Sequence[Job], language: Language) -> bool:
    """Mend the files; what was changed, and what was not, goes to stderr. Whether all could be written."""
    all_written = True
    for job in jobs:
        if not (isinstance(job.source, Path) and job.source.is_file()):
            continue
        try:
            mend = fix_file(job.source, job.name, job.settings, job.known)
        except FileUnreadableError as error:
            say(Words(language)("commands.error", message=error.message), err=True)
            all_written = False
        else:
            if mend:
                write(mend.diff + unmended_text(mend, language, width_of(outlet(err=True))), err=True)
    return all_written


def show_diffs(jobs: Sequence[Job], file: Path | None, language: Language) -> int:
    """Show what `fix_files` would change, on stdout or in a file, and on stderr what it would not; nothing is mended.

    The exit code: 2 where a file cannot be read, else 1 where one would be changed.
    """
    with _taking(file, language) as put:
        return max((_show(job, put, language) for job in jobs), default=0)


def _show(job: Job, put: _Put, language: Language) -> int:
    assert isinstance(job.source, Path)  # noqa: S101 - the command refuses the standard input
    try:
        mend = mended(job.source, job.name, job.settings, job.known)
    except ProgramError as error:
        for line in describe(job.name, error):
            say(line, err=True)
        return 2
    except FileUnreadableError as error:
        say(Words(language)("commands.error", message=error.message), err=True)
        return 2
    if mend.changed:
        put(mend)
    write(unmended_text(mend, language, width_of(outlet(err=True))), err=True)
    return int(mend.changed)


@contextmanager
def _taking(file: Path | None, language: Language) -> Iterator[_Put]:
    """Where the diffs go: into the file or into what reads stdout byte for byte, onto a terminal for people."""
    if file:
        with staged(file.parent, [file.name]) as folder, (folder / file.name).open("wb") as made:
            yield lambda mend: made.write(mend.patch)
    elif outlet().isatty():
        yield lambda mend: write(mend.diff)
    else:
        yield lambda mend: _print_patch(mend, language)


def _print_patch(mend: Mended, language: Language) -> None:
    """Print a patch byte for byte, unless that is what a log must not hold: what reads stdout may be a log."""
    if not write_exactly(mend.patch, f"{mend.program.name}\n{mend.program.text}\n{mend.text}"):
        write(mend.diff)
        say(Words(language)("findings.not-exact", name=mend.program.name), err=True)
