"""A class marked: hand-ins of a folder, and plain programs in folders by pupil, to marks, pages and sheets.

Marks as a spreadsheet (XLSX), by XlsxWriter: the marks, and what is wrong most often.
"""

import csv
import io
from collections.abc import Iterator, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Final, NamedTuple

from parser.files import read_bytes
from parser.findings.errors import FileUnreadableError, ProgramError, system_message
from parser.text.encoding import decode_text, printable
from sim.base.files import staged
from sim.make.lessons import ReadyLesson
from sim.show.class_page import class_page, pupil_page
from sim.show.class_page.page import flags_of, slip_text
from sim.show.lesson_page.page import lesson_entry
from sim.show.texts import bilingual
from sim.teach.handins import MOST_BYTES, SUFFIX, HandIn, HandInError, read_hand_in
from sim.teach.lesson import ProgramExercise
from sim.teach.marking import ClassResult, Marking, PupilMark, Slip, Unread, alike, commonest, marked
from sim.teach.plain.program import PARTS, parts_of, program_share
from sim.teach.programs import program_marked

FIXED: Final = ("index.html", "marks.csv", "marks.xlsx")
MOST_FILES: Final = 20_000
_PROGRAMS: Final = (".3b", ".4b", ".iso", ".nc", ".cnc", ".ngc", ".tap")
_FORMULA: Final = ("=", "+", "-", "@", "\t", "\r")
_MARK: Final = "\ufeff"
"""Tells spreadsheets that a file is UTF-8."""


def marking_of(ready: ReadyLesson) -> Marking:
    """By what a lesson is marked."""
    lesson = ready.lesson
    points = tuple(exercise.points for exercise in lesson.exercises)
    return Marking(lesson.numbers, lesson.seed, points, tuple(exercise.rules for exercise in ready.exercises))


class _Marked(NamedTuple):
    hand_in: HandIn
    mark: PupilMark


def class_result(ready: ReadyLesson, folder: Path) -> ClassResult:
    """All that pupils handed in, in a folder and those within it, marked.

    Files ``*.drycut.json`` are hand-ins. Programs in a folder of their own are those of the pupil by whose name it
    goes. Of the same name and class the best counts. FileUnreadableError where the folder cannot be read.
    """
    marking, unread = marking_of(ready), list[Unread]()
    found = [*_handed_in(ready, marking, folder, unread), *_written(ready, marking, folder, unread)]
    best: dict[tuple[str, str], _Marked] = {}
    for each in found:
        key = (each.mark.group, each.mark.name)
        if key in best:
            unread.append(Unread(f"{each.mark.group} {each.mark.name}".strip(), "twice"))
        if key not in best or each.mark.sum > best[key].mark.sum:
            best[key] = each
    chosen = [best[key] for key in sorted(best)]
    hand_ins = tuple(each.hand_in for each in chosen)
    marks = tuple(each.mark for each in chosen)
    return ClassResult(
        title=ready.lesson.title,
        exercises=tuple(exercise.title for exercise in ready.lesson.exercises),
        points=marking.points,
        rules=marking.rules,
        hand_ins=hand_ins,
        marks=marks,
        common=tuple(commonest(marks)),
        alike=tuple(alike(marking, hand_ins, marks)),
        unread=tuple(unread),
    )


def _files(folder: Path) -> list[Path]:
    """Files of a folder and of those within it, two deep, in order; no links out of it."""
    try:
        next(folder.iterdir(), None)
        paths = sorted([*folder.glob("*"), *folder.glob("*/*")])
    except OSError as error:
        raise FileUnreadableError("cannot-be-read", file=folder, why=system_message(error)) from None
    own = (path for path in paths if not path.is_symlink() and (path.parent == folder or not path.parent.is_symlink()))
    return [path for path in own if path.is_file()][:MOST_FILES]


def _handed_in(ready: ReadyLesson, marking: Marking, folder: Path, unread: list[Unread]) -> Iterator[_Marked]:
    digest = lesson_entry(ready)["lesson"]
    tasks = tuple(rules.tasks for rules in marking.rules)
    for path in _files(folder):
        if not path.name.lower().endswith(SUFFIX):
            continue
        try:
            data = b"" if path.stat().st_size > MOST_BYTES else read_bytes(path)
            if not data:
                raise HandInError("too-long" if path.stat().st_size else "no-json")
            hand_in = read_hand_in(data, digest, tasks)
        except (HandInError, FileUnreadableError, OSError) as error:
            why = error.why if isinstance(error, HandInError) else "no-json"
            unread.append(Unread(_name(folder, path), why))
            continue
        yield _Marked(hand_in, marked(marking, hand_in))


def _name(folder: Path, path: Path) -> str:
    return printable(str(path.relative_to(folder)))


def _written(ready: ReadyLesson, marking: Marking, folder: Path, unread: list[Unread]) -> Iterator[_Marked]:
    """Pupils whose programs stand in a folder by their name."""
    of_pupils: dict[str, list[Path]] = {}
    for path in _files(folder):
        if path.parent != folder and path.suffix.lower() in _PROGRAMS:
            of_pupils.setdefault(path.parent.name, []).append(path)
    for name, paths in of_pupils.items():
        shares: dict[int, _Program] = {}
        for path in paths:
            at = _exercise_of(ready, path)
            program = None if at is None else _program(ready, at, path)
            if at is None or program is None:
                unread.append(Unread(_name(folder, path), "no-exercise" if at is None else "no-program"))
            elif at not in shares or program.share > shares[at].share:
                shares[at] = program
        if shares:
            yield _of_programs(marking, printable(name), shares)


class _Program(NamedTuple):
    text: str
    share: float
    wrong: tuple[str, ...]


def _exercise_of(ready: ReadyLesson, path: Path) -> int | None:
    """The exercise, from 0, that a program is of: its name begins with the number, or there is only one."""
    numbers = [at for at, each in enumerate(ready.exercises) if isinstance(each.exercise, ProgramExercise)]
    digits = path.name[: len(path.name) - len(path.name.lstrip("0123456789"))]
    if digits and len(digits) < 4 and int(digits) - 1 in numbers:
        return int(digits) - 1
    return numbers[0] if len(numbers) == 1 else None


def _program(ready: ReadyLesson, at: int, path: Path) -> _Program | None:
    exercise, rules = ready.exercises[at].exercise, ready.exercises[at].rules
    assert isinstance(exercise, ProgramExercise)  # noqa: S101 - `_exercise_of` says so
    try:
        text = decode_text(read_bytes(path))[0]
        mark = program_marked(text, path.name, rules.target, exercise.offset_um)
    except (ProgramError, FileUnreadableError):
        return None
    wrong = tuple(part for part, right in zip(PARTS, parts_of(mark), strict=True) if right == 0)
    return _Program(text, program_share(mark, rules.weights), wrong)


def _of_programs(marking: Marking, name: str, programs: Mapping[int, _Program]) -> _Marked:
    """A pupil by what his programs earn; all other exercises are not answered."""
    shares = tuple(
        (programs[at].share,) if at in programs else (0.0,) * rules.tasks for at, rules in enumerate(marking.rules)
    )
    points = tuple(most * programs[at].share if at in programs else 0.0 for at, most in enumerate(marking.points))
    answers = tuple(
        ((programs[at].text,),) if at in programs else ((),) * rules.tasks for at, rules in enumerate(marking.rules)
    )
    none = (0.0,) * len(points)
    hand_in = HandIn(name, "", name, marking.seed_of(name), answers, points, none)
    slips = tuple(Slip(at, part) for at, program in programs.items() for part in program.wrong)
    return _Marked(
        hand_in, PupilMark(name, "", hand_in.seed, shares, points, none, slips, is_changed=False, is_of_other=False)
    )


def marks_into(result: ClassResult, folder: Path) -> list[str]:
    """Write pages and sheets of a class into a folder, all or none; gives their names."""
    files = tuple(f"pupil-{number:04}.html" for number in range(1, len(result.marks) + 1))
    with staged(folder, [*FIXED, *files]) as stage:
        (stage / FIXED[0]).write_text(class_page(result, files), "utf-8")
        for number, file in enumerate(files):
            (stage / file).write_text(pupil_page(result, number), "utf-8")
        rows = list(_rows(result))
        (stage / FIXED[1]).write_text(_csv(rows), "utf-8", newline="")
        (stage / FIXED[2]).write_bytes(sheet_of(rows, _common_rows(result)))
    return [*FIXED, *files]


Cell = str | float


def _rows(result: ClassResult) -> Iterator[list[Cell]]:
    """Heads, and a row for each pupil, in Chinese and English: a sheet has no language of its own."""
    heads = [_both("class.group"), _both("class.name")]
    heads += [f"{at} {title.zh} / {title.en}" for at, title in enumerate(result.exercises, 1)]
    yield [*heads, _both("class.sum"), _both("class.minutes"), _both("class.notes")]
    for mark in result.marks:
        notes = "; ".join(" / ".join((flag.zh, flag.en)) for flag in flags_of(mark))
        points = [round(each, 2) for each in mark.points]
        yield [mark.group, mark.name, *points, round(mark.sum, 2), round(sum(mark.seconds) / 60.0, 1), notes]


def _common_rows(result: ClassResult) -> list[list[Cell]]:
    rows: list[list[Cell]] = []
    for slip, count in result.common:
        text, title = slip_text(result, slip), result.exercises[slip.exercise]
        rows.append([float(count), f"{text.zh} / {text.en}", f"{slip.exercise + 1} {title.zh} / {title.en}"])
    return rows


def _both(key: str) -> str:
    text = bilingual(key)
    return f"{text.zh} / {text.en}"


def _csv(rows: list[list[Cell]]) -> str:
    """Rows as RFC 4180 has them; no text is a formula to a spreadsheet."""
    out = io.StringIO()
    writer = csv.writer(out)
    for row in rows:
        writer.writerow([bare(cell) if isinstance(cell, str) else cell for cell in row])
    return _MARK + out.getvalue()


def bare(text: str) -> str:
    """A text that no spreadsheet takes for a formula."""
    return f"'{text}" if text.startswith(_FORMULA) else text


_MADE: Final = datetime(2020, 1, 1, tzinfo=UTC).replace(tzinfo=None)
"""The same marks give the same bytes."""
_WIDE: Final = 14
_TEXTS: Final = {"strings_to_formulas": False, "strings_to_urls": False, "strings_to_numbers": False}


def sheet_of(marks: Sequence[Sequence[str | float]], common: Sequence[Sequence[str | float]]) -> bytes:
    """Bytes of a workbook: heads and a row for each pupil on its first sheet, what is wrong on its second.

    Every text is a text, whatever it looks like.
    """
    import xlsxwriter  # noqa: PLC0415 - of an extra, and for this alone

    out = io.BytesIO()
    book: Any = xlsxwriter.Workbook(out, {"in_memory": True, **_TEXTS})
    book.set_properties({"created": _MADE})
    head = book.add_format({"bold": True, "text_wrap": True, "valign": "top"})
    for key, rows in (("class.title", marks), ("class.sheet-common", common)):
        sheet = book.add_worksheet(" ".join(reversed(bilingual(key))))
        for at, row in enumerate(rows):
            for column, cell in enumerate(row):
                write = sheet.write_string if isinstance(cell, str) else sheet.write_number
                write(at, column, cell, *([head] if at == 0 and rows is marks else []))
        sheet.set_column(0, max((len(row) for row in rows), default=1) - 1, _WIDE)
        if rows is marks:
            sheet.freeze_panes(1, 2)
    book.close()
    return out.getvalue()
