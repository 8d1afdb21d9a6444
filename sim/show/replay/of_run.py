"""Questions about a run as a whole, each asked before one of its blocks: side, offset, and where its fault is."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from parser.findings.catalogue import LANGUAGES, Bilingual, texts
from parser.findings.codes import Severity
from parser.findings.findings import Finding, edited
from parser.program import Program, parse_program
from sim.check.blame.settle import told_of
from sim.check.file_check import check_program
from sim.check.settings import CheckSettings
from sim.run.dryrun import DryRun
from sim.setup.quiz import WrittenQuestion
from sim.show.texts import bilingual
from sim.show.texts.phrases import same

_MOST_FAULTS = 8
_ANSWERS = 4
_MOST_BLOCKS = 5_000
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
    if not faulty or run.program.mender is None or len(run.toolpath) > _MOST_BLOCKS:
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
