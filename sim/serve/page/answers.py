"""What the page is told of a program: its findings with their mends, its path in columns, its figures and its size."""

from collections.abc import Iterable
from pathlib import Path
from typing import Final, NamedTuple

import numpy as np

from controller.motion.limits import Feeds
from controller.stepping.steps import interpolate
from parser.documents import SaidEntry
from parser.findings.catalogue import LANGUAGES, Bilingual, CataloguePage, page, texts
from parser.findings.findings import Finding
from parser.program import Program, usual_name
from parser.shape.contours import find_contours
from parser.shape.passes import find_passes, leads_of
from parser.text.encoding import decode_text, encode_text, printable
from parser.text.source import LINE_END
from parser.toolpath import Toolpath
from sim.base.units import numbers, rounded
from sim.check.file_check import as_typed
from sim.check.result import CheckResult
from sim.serve.page.form import USUAL, Chosen
from sim.serve.page.model import (
    AnswerEntry,
    ExplainedEntry,
    FigureEntry,
    FileTextEntry,
    FindingEntry,
    PathEntry,
    SizeEntry,
)
from sim.show.replay.tape import exact_columns
from sim.show.texts import bilingual
from sim.show.texts.phrases import lasting


class ReadFile(NamedTuple):
    """The text of a file with lines that end with LF, as a page has it, and what brings back its bytes.

    `newline` is how all its lines end; of a file that mixes line ends, a letter of `_ENDS` for each line, in order.
    """

    text: str
    encoding: str
    newline: str


_ENDS: Final = {"w": "\r\n", "u": "\n", "m": "\r"}
"""Letter of a line -> its end."""


def read_file(data: bytes) -> ReadFile:
    """The text of a file's bytes. ProgramError (3B100) where they are no text."""
    text, encoding = decode_text(data)
    ends = LINE_END.findall(text)
    letter = {end: letter for letter, end in _ENDS.items()}
    mixed = "".join(letter[end] for end in ends) if len(set(ends)) > 1 else ""
    return ReadFile(LINE_END.sub("\n", text), encoding, mixed or (ends[0] if ends else "\n"))


def file_text(name: str, read: ReadFile, number: str = "") -> FileTextEntry:
    """A file as the page has it; `number` is that of its program, empty where it came to the page."""
    return {
        "name": printable(name),
        "text": read.text,
        "encoding": read.encoding,
        "newline": read.newline,
        "number": number,
    }


def printable_entry(message: Bilingual) -> SaidEntry:
    """A message, which may cite a file, as the page shows it."""
    return {"en": printable(message.en), "zh": printable(message.zh)}


def file_of(read: ReadFile, text: str) -> bytes:
    """The bytes of a text made of a file as read; where its encoding lacks a letter, all of it is in UTF-8.

    Of mixed line ends each line that stayed has its own; lines put between others end as the one that stood there.
    """
    ends = _line_ends(read, text)
    whole = "".join(part for line, end in zip(text.split("\n"), [*ends, ""], strict=True) for part in (line, end))
    try:
        return encode_text(whole, read.encoding)
    except (ValueError, LookupError):  # it lacks a letter, or is no name of an encoding
        return whole.encode("utf-8", "replace")


def _line_ends(read: ReadFile, text: str) -> list[str]:
    """The end of each line of a text but the last."""
    count = text.count("\n")
    was = [_ENDS[letter] for letter in read.newline if letter in _ENDS]
    if not was:
        return [read.newline if read.newline in _ENDS.values() else "\n"] * count
    before, after = read.text.split("\n")[:-1], text.split("\n")[:-1]
    most = min(len(was), count)
    head = next((at for at in range(most) if before[at] != after[at]), most)
    most -= head
    tail = next((at for at in range(most) if before[~at] != after[~at]), most)
    between = [was[min(at, len(was) - 1)] for at in range(head, count - tail)]
    return [*was[:head], *between, *was[len(was) - tail :]]


def answer(name: str, file: Path | None, text: str, for_run: Chosen = USUAL) -> AnswerEntry:
    """What is found in a text, and its path; an empty name is given the usual one.

    `file` is where the text stands, None where nobody knows.
    """
    name = name or usual_name(text)
    found, offsets = as_typed(name, file, text, for_run.machine), Offsets(text)
    program, result = found.program, found.result
    return {
        "name": printable(name),
        "dialect": result.dialect,
        "verdict": "none" if result.unreadable else result.outcome,
        "settings": printable(found.wrong_settings),
        "findings": [_finding(finding, offsets) for finding in result.findings],
        "pages": pages_of(result.findings),
        "path": _path(program, offsets, for_run.feeds) if program and len(program.toolpath) else None,
        "figures": _figures(program) if program and result.coverage.stepped else [],
        "size": size_of(result, for_run),
        "machine": for_run.title.entry(),
    }


def found_in(text: str, findings: Iterable[Finding]) -> list[FindingEntry]:
    """Findings of a text as the page lists them."""
    offsets = Offsets(text)
    return [_finding(finding, offsets) for finding in findings]


def pages_of(findings: Iterable[Finding]) -> dict[str, ExplainedEntry]:
    """The pages of the codes of some findings: ``why`` and ``mend``, Markdown."""
    codes = sorted({finding.code for finding in findings})
    return {code: _explained(*(page(code, language) for language in LANGUAGES)) for code in codes}


def _explained(en: CataloguePage, zh: CataloguePage) -> ExplainedEntry:
    return {"why": {"en": en.why, "zh": zh.why}, "mend": {"en": en.mend, "zh": zh.mend}}


class Offsets:
    """Places of characters in a text, as a page counts them: in units of UTF-16."""

    def __init__(self, text: str) -> None:
        beyond = np.array([letter > "\uffff" for letter in text], dtype=np.int64) if not text.isascii() else None
        self._before = None if beyond is None else np.concatenate([[0], np.cumsum(beyond)])

    def of(self, character: int) -> int:
        """Units before a character."""
        return character if self._before is None else character + int(self._before[character])


def _finding(finding: Finding, offsets: Offsets) -> FindingEntry:
    en, zh = (texts(finding, language) for language in LANGUAGES)
    return {
        "code": finding.code,
        "severity": str(finding.severity),
        "title": {"en": en.title, "zh": zh.title},
        "message": {"en": en.message, "zh": zh.message},
        "hint": {"en": en.hint, "zh": zh.hint},
        "line": finding.line,
        "block": finding.block,
        "block_name": finding.block_name,
        "first": offsets.of(finding.span[0]),
        "past": offsets.of(finding.span[1]),
        "edits": [(offsets.of(edit.first), offsets.of(edit.past), edit.text) for edit in finding.edits],
    }


def _path(program: Program, offsets: Offsets, feeds: Feeds) -> PathEntry:
    """Columns of n blocks, and where each stands in the text; ``border_s`` has n + 1.

    That is when each block begins at the feeds alone, without accelerations and stops: a run tells it exactly.
    """
    path, source = program.toolpath, program.toolpath.source
    took_s = path.length_um / np.where(path.is_jump, feeds.jump_um_s, feeds.cut_um_s)
    return {
        **exact_columns(path),
        "border_s": numbers(np.append(0.0, np.cumsum(took_s))),
        "is_lead": leads_shown(path),
        "line": source.line.tolist(),
        "first": [offsets.of(first) for first in source.span[:, 0].tolist()],
        "past": [offsets.of(past) for past in source.span[:, 1].tolist()],
        "name": source.names.of_rows(),
    }


def leads_shown(path: Toolpath) -> list[bool]:
    """Which of the n blocks of a path are drawn as leads: none where nothing is cut in passes."""
    passes = find_passes(path)
    return leads_of(passes, path).tolist() if passes.passes else [False] * len(path)


def _figures(program: Program) -> list[FigureEntry]:
    path = program.toolpath
    contours = find_contours(path, interpolate(path).corner_um)
    return [
        {
            "first": contour.first,
            "last": contour.last,
            "length_um": rounded(float(path.length_um[contour.first - 1 : contour.last].sum())),
            "closes": None if not contour.encloses else not contour.is_open,
            "thread_um": [rounded(place) for place in path.start_um[contour.first - 1].tolist()],
        }
        for contour in contours
    ]


def size_of(result: CheckResult, for_run: Chosen = USUAL) -> SizeEntry | None:
    """How large a program is, lengths in µm, and about how long it takes; None where its path is not known."""
    programmed = result.programmed
    if programmed is None:
        return None
    return {
        "lines": programmed.lines,
        "arcs": programmed.arcs,
        "rapids": programmed.rapids,
        "cut_um": rounded(programmed.cut_length_um),
        "box_um": None if programmed.box_um is None else [rounded(place) for place in programmed.box_um],
        "steps": result.steps,
        "time": _about(programmed.cut_length_um, result.length_um, for_run).entry(),
    }


def _about(cut_um: float, length_um: float, for_run: Chosen) -> Bilingual:
    """How long the feeds of the machine take, without accelerations and stops: a run tells it exactly."""
    feeds = for_run.feeds
    time_s = cut_um / float(feeds.cut_um_s) + (length_um - cut_um) / feeds.jump_um_s
    return bilingual("open.time", time=lasting(time_s), machine=for_run.known_as, thickness=f"{for_run.thickness_mm:g}")
