"""A program made of a drawing, on the terminal: its figures, what it left out, and its proof.

The proof of a made program on the terminal: how far it is off, what was found, and the verdict.
"""

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from parser.drawing.model import LeftOut
from parser.findings.catalogue import LANGUAGES, Bilingual, Language, Remark, remark_text, texts
from parser.findings.codes import Severity
from parser.findings.findings import ReadAs
from parser.text.encoding import printable
from parser.units import mm
from sim.base.units import hours_text
from sim.make.cam.document import FigureSum, figure_sums
from sim.make.cam.maker import MadeProgram, NotMade
from sim.make.cam.model import CutPlan, FigureCut
from sim.make.cam.proof_model import Proof
from sim.make.wanted import upper_file
from sim.show.refusals import place_text, places_said, why_refused
from sim.show.terminal.finding import finding_lines
from sim.show.terminal.layout import show, table
from sim.show.terminal.printer import COLOURS, painted, say, styled
from sim.show.terminal.streams import outlet
from sim.show.terminal.wrap import width_of, wrapped
from sim.show.texts import Words, bilingual
from sim.show.texts.phrases import listed, machine_name, numbered, same

_INDENT = "    "
_MOST_FINDINGS = 20


def proof_lines(done: MadeProgram, name: str, language: Language, width: int) -> Iterator[str]:
    """What the proof of a program shows, in lines of `width` cells."""
    proof, words = done.proof, Words(language)
    if proof is None:
        return
    found = [
        each_finding
        for each_finding in proof.findings
        if not isinstance(each_finding.fact, ReadAs) and each_finding.severity is not Severity.NOTE
    ]
    for finding in found[:_MOST_FINDINGS]:
        excerpt = done.program.excerpt(finding.line) if finding.column else None
        for line in finding_lines(name, finding, excerpt, language, width):
            yield painted(line, finding.severity)
    if len(found) > _MOST_FINDINGS:
        yield words("program.more-findings", more=f"{len(found) - _MOST_FINDINGS:,}")
    for text in said_of_proof(proof, words):
        yield from wrapped(text, width, "", _INDENT)
    for text in advice(done, language, words("program.tab-option")):
        yield from wrapped(text, width, "", _INDENT)
    edge = proof.comparison
    if edge is not None and proof.run is not None:
        text = words(
            "program.edge",
            there=f"{float(edge.edge_to_drawing.max_um.max()):.2f}",
            back=f"{float(edge.drawing_to_edge.max_um.max()):.2f}",
            tolerance=f"{edge.request.tolerance_um:g}",
            machine=machine_name(proof.run.scenario.machine),
        )
        yield from wrapped(text, width, "", _INDENT)
    if proof.walls and all(wall.off_um < math.inf for wall in proof.walls):
        yield from wrapped(_walls(done, words), width, "", _INDENT)
    yield styled(words(f"program.verdict-{proof.verdict}"), f"bold {COLOURS[proof.verdict]}")


def _walls(done: MadeProgram, words: Words) -> str:
    walls = () if done.proof is None else done.proof.walls
    off = f"{max(wall.off_um for wall in walls):.2f}"
    heights = len({wall.z_um for wall in walls})
    return words("program.walls", heights=heights, off=off, tolerance=f"{done.plan.making.held_to_um:g}")


def advice(done: MadeProgram, language: Language, tab: str) -> Iterator[str]:
    """What to do where a part comes free too early; `tab` says how a tab is asked for."""
    if _is_early(done):
        yield Words(language)("program.advice-tab", tab=tab)


def _is_early(done: MadeProgram) -> bool:
    """Whether a part comes free before the last of its passes, and a tab would hold it."""
    run = done.proof and done.proof.run
    if not run or run.remains is None or done.plan.making.tab_um:
        return False
    is_trimmed = any(len(cut.passes) > 1 and not cut.figure.runs_inside for cut in done.plan.cuts)
    return is_trimmed and any(piece.early for piece in run.remains.pieces.freed if piece.kind == "part")


def said_of_proof(proof: Proof, words: Words) -> Iterator[str]:
    """What the proof found wrong by itself, what it could not prove, and what it assumed."""
    for fault in proof.faults:
        text = words(f"program.fault-{fault.name}", **fault.values)
        yield words("program.of-figure", figure=fault.figure, what=text) if fault.figure else text
    for unproved in proof.unproved:
        yield words(f"program.unproved-{unproved.name}", **unproved.values)
    for note in proof.notes:
        yield words("program.note", what=words(f"program.proof-{note.name}", **note.values))


def against(done: MadeProgram, language: Language) -> Iterator[str]:
    """What speaks against a program, a text for each: findings, faults, and what could not be proved."""
    proof, words = done.proof, Words(language)
    if proof is None:
        return
    for finding in proof.counting[:_MOST_FINDINGS]:
        at = f" {finding.block_name}" if finding.block else ""
        yield f"{finding.code}{at}: {texts(finding, language).found}"
    yield from said_of_proof(proof._replace(notes=()), words)


_MOST_FIGURES = 40
_MOST_DETAILS = 3
_LEFT_OUT = {
    "beyond",
    "broken-line",
    "drawn-twice",
    "no-width",
    "dot",
    "never-plotted",
    "no-curves",
    "other-layers",
    "overlaps",
    "unreadable",
    "upright",
}
"""Notes of the reader that say in sum what `CutPlan.left_out` has one by one."""
_HEADS = ("number", "kind", "wire", "blocks", "length", "time", "thread")


def print_made(done: MadeProgram, name: Path, where: str, picture: Path | None, language: Language) -> None:
    """Print figures, what was left out and taken for granted, and the proof of a program to stdout.

    `where` says what became of it: ``written``, ``forced``, ``held-back``, ``previewed``. `picture` was drawn of it.
    """
    words, width = Words(language), width_of(outlet())
    sums = figure_sums(done)
    passes = set(map(_passes, done.plan.cuts))
    names = (*_HEADS, "passes") if len(passes) > 1 else _HEADS
    shown_table = table(
        printable(name.name), tuple(words(f"program.head-{each_name}") for each_name in names), right=(0, 3, 4, 5)
    )
    for cut, of in list(zip(done.plan.cuts, sums, strict=False))[:_MOST_FIGURES]:
        shown_table.add_row(*_row(cut, of, words)[: len(names)])
    show(shown_table)
    for line in (*_total(done.plan, sums, words, width), *told_lines(done.plan, language, width)):
        say(line)
    if done.proof is not None:
        for line in proof_lines(done, str(name), language, width):
            say(line)
    for text in to_check(done.plan, language):
        for line in wrapped(text, width, "", _INDENT):
            say(styled(line, COLOURS["to-check"]))
    for text in _became(done, name, where, picture, words):
        for line in wrapped(text, width, "", _INDENT):
            say(line)


def _became(done: MadeProgram, name: Path, where: str, picture: Path | None, words: Words) -> Iterator[str]:
    """What became of a program and its picture, and where its upper contour stands."""
    if picture is not None:
        yield words("program.written", out=picture)
    yield words(f"program.{where}", out=name)
    if done.upper_data is not None and where in {"written", "forced"}:
        yield words("convert.upper", out=printable(str(upper_file(name))))


def to_check(plan: CutPlan, language: Language) -> Iterator[str]:
    """What makes a program that is proved one to be checked: contours that are not cut, a unit that may be another."""
    words = Words(language)
    if plan.to_check:
        several = "not-cut" if len(plan.to_check) == 1 else "some-not-cut"
        yield words("program.to-check", what=words(f"program.{several}", n=f"{len(plan.to_check):,}"))
    for doubt in plan.doubts:
        yield words("program.to-check", what=_note(doubt, words))


def print_not_made(refused: NotMade, name: Path, language: Language) -> None:
    """Print why nothing was written."""
    text = Words(language)("program.not-written", name=printable(str(name)), why=why_refused(refused.refusal))
    for line in wrapped(text, width_of(outlet()), "", _INDENT):
        say(styled(line, "red"))


def told_lines(plan: CutPlan, language: Language, width: int) -> Iterator[str]:
    """The fit, what was left out, and what was chosen or taken for granted, in lines of `width` cells."""
    words = Words(language)
    texts = [*_same_passes(plan, words), *_fit(plan, words), *_left_out(plan.left_out, words), *_chosen(plan, words)]
    details = [each.detail for each in plan.left_out]
    notes = (note for note in plan.drawing.notes if note not in details and note not in plan.doubts)
    notes = (note for note in (*notes, *plan.notes) if note.name not in _LEFT_OUT or not plan.left_out)
    texts += [words("program.note", what=_note(note, words)) for note in notes]
    for text in texts:
        yield from wrapped(text, width, "", _INDENT)


def _note(note: Remark, words: Words) -> str:
    """What the reader of drawings remarks, by the catalogue; else what the maker does, by its own words."""
    try:
        return remark_text(note, words.language)
    except KeyError:
        return words(f"program.note-{note.name}", **note.values)


def _row(cut: FigureCut, of: FigureSum, words: Words) -> tuple[str, ...]:
    return (
        str(cut.figure.number),
        words(f"program.kind-{cut.figure.kind}", part=cut.figure.part),
        words("program.wire-inside" if cut.figure.runs_inside else "program.wire-outside"),
        f"{of.blocks:,}",
        f"{mm(of.length_um):,.3f}",
        hours_text(of.time_s) if of.time_s else "–",
        place_text(cut.thread.place_um),
        _passes(cut),
    )


def _passes(cut: FigureCut) -> str:
    return ", ".join(f"{mm(pass_.by_um):g}" for pass_ in cut.passes)


def _total(plan: CutPlan, sums: tuple[FigureSum, ...], words: Words, width: int) -> Iterator[str]:
    more = len(plan.cuts) - _MOST_FIGURES
    if more > 0:
        yield words("program.more-figures", more=f"{more:,}")
    length = mm(sum(figure_sum.length_um for figure_sum in sums))
    counted = getattr(
        numbered({"figure": len(sums), "block": sum(figure_sum.blocks for figure_sum in sums)}), words.language
    )
    text = words("program.total", counted=counted, length=f"{length:,.3f}")
    yield from wrapped(text, width, "", _INDENT)


def _same_passes(plan: CutPlan, words: Words) -> Iterator[str]:
    """The passes where they are the same for all figures, else the table has them; holes without a core, and tabs."""
    passes = set(map(_passes, plan.cuts))
    if len(passes) == 1:
        yield words("program.passes", passes=passes.pop()) if any(plan.passes_um) else words("program.passes-none")
    no_core = [cut.figure.number for cut in plan.cuts if cut.is_coreless]
    if no_core:
        yield words("program.coreless", figures=_numbers(no_core))
    making = plan.making
    tabs = [cut.figure.number for cut in plan.cuts if cut.cut_off and not cut.figure.runs_inside]
    if tabs:
        yield words("program.tabs", figures=_numbers(tabs), length=f"{mm(making.tab_um):g}")
    slugs = [cut for cut in plan.cuts if cut.figure.runs_inside and not cut.is_coreless] if making.slug_tab_um else []
    for key, is_there in (("slug-tabs", True), ("no-slug-tabs", False)):
        numbers = [cut.figure.number for cut in slugs if bool(cut.cut_off) is is_there]
        if numbers:
            yield words(f"program.{key}", figures=_numbers(numbers), length=f"{mm(making.slug_tab_um):g}")
    if making.in_rounds and len(plan.visits) > len(plan.cuts):
        yield words("program.in-rounds", contours=f"{len(plan.of_contour):,}")


def _fit(plan: CutPlan, words: Words) -> Iterator[str]:
    fit = plan.drawing.fit
    if fit is not None:
        yield words(
            "program.fit",
            arcs=f"{fit.arcs:,}",
            lines=f"{fit.lines:,}",
            max=f"{fit.max_um:.3f}",
            tolerance=f"{plan.making.tolerance_um:g}",
        )


def _left_out(left_out: tuple[LeftOut, ...], words: Words) -> Iterator[str]:
    """A line for each reason, with the kinds of entities and the first places."""
    by_reason: dict[tuple[object, ...], list[LeftOut]] = defaultdict(list)
    for each_left_out in left_out:
        by_reason[each_left_out.why, each_left_out.values].append(each_left_out)
    for ones in by_reason.values():
        kinds: dict[str, int] = defaultdict(int)
        for excluded in ones:
            kinds[excluded.entity.kind] += 1
        counted = listed(same(f"{number:,} {printable(kind)}") for kind, number in kinds.items())
        places = tuple(dict.fromkeys(excluded.place_um for excluded in ones if excluded.place_um is not None))
        text = bilingual("program.left-out", what=counted, why=_why(ones))
        yield getattr(_with_places(text, places), words.language)


def _why(ones: Sequence[LeftOut]) -> Bilingual:
    """Why entities are in no figure, with what is wrong with the first few, or how near the nearest is to closing."""
    why = bilingual(f"program.left-out-{ones[0].why}", **dict(ones[0].values))
    wrong = [left_out.detail for left_out in ones if left_out.detail is not None][:_MOST_DETAILS]
    gaps_um = [left_out.gap_um for left_out in ones if left_out.gap_um is not None]
    if wrong:
        detail = listed(Bilingual(*(remark_text(each, language) for language in LANGUAGES)) for each in wrong)
    elif gaps_um:
        key = "almost-closed-gap" if ones[0].why == "almost-closed" else "gap"
        detail = bilingual(f"program.left-out-{key}", gap=f"{mm(min(gaps_um)):.3g}")
    else:
        return why
    return bilingual("program.left-out-detail", why=why, detail=detail)


def _with_places(text: Bilingual, places_um: tuple[tuple[float, float], ...]) -> Bilingual:
    return bilingual("program.at", what=text, places=places_said(places_um)) if places_um else text


def _chosen(plan: CutPlan, words: Words) -> Iterator[str]:
    """Thread points that nobody asked for."""
    chosen = [cut.figure.number for cut in plan.cuts if cut.thread.by == "chosen"]
    if chosen:
        yield words("program.chosen", figures=_numbers(chosen))


def _numbers(figures: Sequence[int]) -> str:
    """Numbers in their order, runs of three and more as a range: ``1–20, 22, 23``; the first of very many."""
    ordered = np.sort(np.array(figures, dtype=np.int64))
    runs = np.split(ordered, np.flatnonzero(np.diff(ordered) > 1) + 1)
    names: list[str] = []
    for run in runs:
        names += [f"{run[0]}–{run[-1]}"] if len(run) > 2 else map(str, run)
    return ", ".join(names[:_MOST_FIGURES]) + ("…" if len(names) > _MOST_FIGURES else "")
