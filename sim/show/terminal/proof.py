"""The proof of a made program on the terminal: how far it is off, what was found, and the verdict."""

from collections.abc import Iterator

from parser.findings.catalogue import Language, texts
from parser.findings.codes import Severity
from parser.findings.findings import ReadAs
from sim.make.cam.maker import MadeProgram
from sim.make.cam.proof.target import Proof
from sim.show.terminal.colours import COLOURS, painted, styled
from sim.show.terminal.finding import finding_lines
from sim.show.terminal.wrap import wrapped
from sim.show.texts import Words
from sim.show.texts.phrases import machine_name

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
    if _is_early(done):
        yield from wrapped(words("program.advice-tab"), width, "", _INDENT)
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
    yield styled(words(f"program.verdict-{proof.verdict}"), f"bold {COLOURS[proof.verdict]}")


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
