"""The quiz of a replay: what its scenario asks, and sets of questions about any run.

Questions about a run as a whole, each asked before one of its blocks: side, offset, and where its fault is.

A question as a replay's document holds it, and those that a scenario asks.
"""

from collections.abc import Iterator
from random import Random
from typing import Any, Final, NamedTuple, get_args

import numpy as np

from controller.stepping.pulses import Pulses
from controller.stepping.steps import words_of
from parser.controller_words import StepWords
from parser.findings.catalogue import LANGUAGES, Bilingual, texts
from parser.findings.codes import Severity
from parser.findings.findings import Finding, edited
from parser.geometry.curves import Ints
from parser.program import Program, parse_program
from parser.text.source import Field
from sim.check.blame.settle import told_of
from sim.check.file_check import check_program
from sim.check.settings import CheckSettings
from sim.run.dryrun import DryRun
from sim.setup.quiz import About, Question, WrittenQuestion
from sim.show.replay.answers import asked_block, written_out
from sim.show.replay.model import QuestionEntry, QuizEntry
from sim.show.texts import bilingual
from sim.show.texts.phrases import same

_MOST_FAULTS = 8
_ANSWERS = 4
_MOST_MENDED_BLOCKS = 5_000
"""Of a program that is checked anew for each question: some 10 ms a time."""


class OfRun(NamedTuple):
    """A question, its kind, and the row of the block before which it is asked."""

    row: int
    about: str
    written: WrittenQuestion


def questions_of(run: DryRun) -> Iterator[OfRun]:
    """Those that there are of a run."""
    cut = np.flatnonzero(~run.toolpath.is_jump)
    if not len(cut):
        return
    first = int(cut[0])
    yield OfRun(first, "offset", _offset(run))
    if run.offset is not None:
        sides = ("left", "right")
        right = sides.index(run.offset.side.name.lower())
        answers = tuple(bilingual(f"quiz.side_{side}") for side in sides)
        yield OfRun(first, "side", WrittenQuestion(bilingual("quiz.side"), answers, right, bilingual("quiz.side_why")))
    yield from _faults(run)


def _offset(run: DryRun) -> WrittenQuestion:
    """How far beside the wire's path the cut edge lies: its radius and the gap, not what else comes to mind."""
    wire = run.scenario.wire
    others = (wire.diameter_um / 2.0, wire.diameter_um, wire.diameter_um + wire.spark_gap_um, wire.kerf_um)
    lengths = [f"{um:g} µm" for um in sorted({round(um, 3) for um in (wire.reach_um, *others)})]
    right = lengths.index(f"{round(wire.reach_um, 3):g} µm")
    values = {"radius": f"{wire.diameter_um / 2.0:g}", "gap": f"{wire.spark_gap_um:g}", "reach": lengths[right]}
    ask = bilingual("quiz.offset", diameter=f"{wire.diameter_um:g}", gap=values["gap"])
    return WrittenQuestion(ask, tuple(map(same, lengths)), right, bilingual("quiz.offset_why", **values))


def _faults(run: DryRun) -> Iterator[OfRun]:
    """Which of some blocks is at fault, for each block that a change of its own words alone rids of its finding.

    Other findings only hang on their block: that a contour stays open is told at its last one, and may come of any.
    """
    faulty = {finding.block for finding in run.findings if finding.block}
    if not faulty or run.program.mender is None or len(run.toolpath) > _MOST_MENDED_BLOCKS:
        return
    checked = check_program(_as_written(run.program, run.program.text), CheckSettings(may_stay_open=True))
    grave = {found.block: found for found in reversed(checked.findings) if found.severity is not Severity.NOTE}
    for block in sorted(block for block in grave if block)[:_MOST_FAULTS]:
        finding = grave[block]
        question = _fault(run, finding, faulty) if _is_rid(run.program, finding) else None
        if question is not None:
            yield question


def _as_written(program: Program, text: str) -> Program:
    """A text read as a program was."""
    return parse_program(text, program.name, program.encoding, program.choices)


def _is_rid(program: Program, finding: Finding) -> bool:
    """Whether the certain mend of a finding changes its block alone, and the finding goes with it."""
    if not finding.edits:
        return False
    edits = [edit for edit in finding.edits if program.lines.line(edit.first) == finding.line]
    if len(edits) < len(finding.edits):
        return False
    again = check_program(_as_written(program, edited(program.text, edits)), CheckSettings(may_stay_open=True))
    return told_of(finding) not in map(told_of, again.findings)


def _fault(run: DryRun, finding: Finding, faulty: set[int]) -> OfRun | None:
    """The block beside its nearest neighbours that have no finding; None where there are no two of those."""
    source, names = run.toolpath.source, run.block_names
    rows = np.flatnonzero(source.block == finding.block)
    near = sorted(set(source.block.tolist()) - faulty, key=lambda other: (abs(other - finding.block), other))
    blocks = sorted([finding.block, *near[: _ANSWERS - 1]])
    if not len(rows) or len(blocks) < 2:
        return None
    title = Bilingual(*(texts(finding, language).title for language in LANGUAGES))
    why = bilingual("quiz.fault_why", block=finding.block_name, code=finding.code, title=title)
    first = int(np.flatnonzero(source.block == blocks[0])[0])
    answers = tuple(same(names.other.get(block, str(block))) for block in blocks)
    return OfRun(first, "fault", WrittenQuestion(bilingual("quiz.fault"), answers, blocks.index(finding.block), why))


_HIDDEN: dict[About, tuple[Field, ...]] = {
    "quadrant": (Field.AXIS, Field.SENSE),
    "count_axis": (Field.AXIS, Field.COUNT),
    "turn": (Field.SENSE,),
    "count_length": (Field.COUNT,),
    "next_step": (),
    "end": (),
}
"""Fields of its block that would tell the answer."""


def question_entries(run: DryRun, steps: Pulses, words: StepWords) -> list[QuestionEntry]:
    """Questions of the scenario in the order of their rows.

    Those that this run has no answer to are left out: of blocks that vanish under an offset, of the first step where
    the card interpolates.
    """
    entries = [_of_scenario(run, steps, words, question) for question in run.scenario.quiz]
    return sorted((entry for entry in entries if entry is not None), key=lambda entry: int(entry["row"]))


def _of_scenario(run: DryRun, steps: Pulses, words: StepWords, question: Question) -> QuestionEntry | None:
    rows = np.flatnonzero(run.toolpath.source.block == question.block)
    if not len(rows):
        return None
    row, what = int(rows[0]), question.what
    if isinstance(what, WrittenQuestion):
        return entry_of(run, row, what, None)
    written = answered(run, steps, words, row, what)
    return written and entry_of(run, row, written, what)


def entry_of(run: DryRun, row: int, written: WrittenQuestion, about: str | None) -> QuestionEntry:
    """A question about the block in a row; its kind is None where a scenario has its own."""
    source = run.toolpath.source
    return {
        "row": row,
        "block": int(source.block[row]),
        "name": source.names.of_row(row),
        "about": about,
        "ask": written.ask.entry(),
        "answers": [answer.entry() for answer in written.answers],
        "right": written.right,
        "why": written.why.entry(),
        "hidden": _hidden(run, row, about),
    }


def _hidden(run: DryRun, row: int, about: str | None) -> list[list[int]]:
    """First character in the block's text, and one past the last, of what would tell the answer."""
    source = run.toolpath.source
    if about == "end":  # programs print it behind the block
        first, past = source.span[row].tolist()
        line_end = source.text.find("\n", past)
        return [[past - first, (line_end if line_end >= 0 else len(source.text)) - first]]
    fields = source.fields_of(source.block_text(row))
    wanted = next((of for kind, of in _HIDDEN.items() if kind == about), ())
    return sorted([*fields[each]] for each in wanted if each in fields)


def answered(run: DryRun, steps: Pulses, words: StepWords, row: int, about: About) -> WrittenQuestion | None:
    """A question about the block in a row; None where it makes no step, or has nothing of the kind."""
    first = int(run.stepped.count[:row].sum())
    if not run.stepped.count[row] or first >= len(steps.t_s):
        return None
    block = asked_block(run, words, row, (int(steps.x_um[first]), int(steps.y_um[first])))
    if about == "turn" and not block.is_arc:
        return None
    if about == "next_step" and run.scenario.machine.controller.interpolation != "point-by-point":
        return None
    return written_out(about, block)


SETS: Final = 99
"""Sets of questions, by number from 1: a class that is told one has the same questions."""
IN_A_SET: Final = 10
_MOST_BLOCKS: Final = 30


def quiz_of(run: DryRun, steps: Pulses) -> QuizEntry:
    """``quiz`` of a replay's document: the scenario's `own` questions, a `pool` of others, and `sets` of those."""
    words = words_of(run.toolpath)
    pool = _pool(run, steps, words)
    return {"own": question_entries(run, steps, words), "pool": pool, "sets": sets_of(pool)}


def sets_of(pool: list[QuestionEntry]) -> list[list[int]]:
    """For each set the indices of its questions, in the order of their rows; none where the pool is empty."""
    kind, block = (_numbered([entry[key] for entry in pool]) for key in ("about", "block"))
    return _sets(kind, block) if pool else []


def _numbered(values: list[Any]) -> Ints:
    """Values as numbers from 0, the same for the same."""
    numbers = {value: number for number, value in enumerate(dict.fromkeys(values))}
    return np.array([numbers[value] for value in values], dtype=np.int64)


def _pool(run: DryRun, steps: Pulses, words: StepWords) -> list[QuestionEntry]:
    """Questions of every kind about blocks that are spread over the program, by their rows."""
    cut = np.flatnonzero(~run.toolpath.is_jump & (run.stepped.count > 0))
    rows = cut[np.unique(np.linspace(0, len(cut) - 1, min(len(cut), _MOST_BLOCKS)).astype(np.int64))].tolist()
    of_blocks = ((row, about, answered(run, steps, words, row, about)) for row in rows for about in _kinds(run))
    entries = [entry_of(run, row, written, about) for row, about, written in of_blocks if written is not None]
    entries += [entry_of(run, question.row, question.written, question.about) for question in questions_of(run)]
    return sorted(entries, key=lambda entry: int(entry["row"]))


def _kinds(run: DryRun) -> tuple[About, ...]:
    """What can be asked about a block: of words where the program has them, of places where no offset moves them."""
    if run.offset is not None:
        return ("quadrant", "turn") if run.toolpath.words is not None else ("turn",)
    every: tuple[About, ...] = get_args(About)
    return every if run.toolpath.words is not None else ("turn", "end")


def _sets(kind: Ints, block: Ints) -> list[list[int]]:
    """Questions, by their kinds and blocks (n,), of as many of both as there are; the others left to chance.

    All sets are chosen at once: each takes the first question in its own order of which it has taken the kind least,
    and then the block.
    """
    order = np.array([_shuffled(len(kind), number) for number in range(1, SETS + 1)])
    kinds, blocks, every = kind[order], block[order], np.arange(SETS)
    of_kind = np.zeros((SETS, kind.max() + 1), dtype=np.int64)
    of_block = np.zeros((SETS, block.max() + 1), dtype=np.int64)
    is_chosen = np.zeros(order.shape, dtype=np.bool_)
    for _ in range(min(IN_A_SET, len(kind))):
        taken = of_kind[every[:, None], kinds] * (IN_A_SET + 1) + of_block[every[:, None], blocks]
        at = np.argmin(np.where(is_chosen, np.iinfo(np.int64).max, taken), axis=1)
        is_chosen[every, at] = True
        of_kind[every, kinds[every, at]] += 1
        of_block[every, blocks[every, at]] += 1
    return [sorted(own[chosen].tolist()) for own, chosen in zip(order, is_chosen, strict=True)]


def _shuffled(count: int, number: int) -> list[int]:
    """Numbers below `count` in an order left to chance, the same for all who are told the number of the set."""
    chance = Random(number)  # noqa: S311 - nothing is kept secret by it
    return sorted(range(count), key=lambda _: chance.random())
