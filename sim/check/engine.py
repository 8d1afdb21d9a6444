"""All checks of one program, and how far each came."""

from typing import TYPE_CHECKING, NamedTuple

from controller.stepping.point_by_point import interpolate
from controller.stepping.steps import Steps
from parser.dialect.reader import in_codes
from parser.findings.codes import Check
from parser.findings.findings import Finding, TooLarge, file_order, telling
from parser.program import Program, parse_program
from parser.shape.contours import Contour, find_contours
from sim.check.compensation.words import compensation_of
from sim.check.path_checks import Demands, check_path, state_of
from sim.check.result import CheckState, Coverage
from sim.check.travel import too_many_steps

if TYPE_CHECKING:  # most programs do not compensate
    from sim.check.pass_over_round import Offsetting

PARSER_CHECKS = (Check.GRAMMAR, Check.ORDER, Check.BLOCKS, Check.PRINTED_ENDS, Check.HEADER)
PATH_CHECKS = (Check.STEPS, Check.CONTOURS, Check.SENSES, Check.CROSSINGS, Check.PASSES, Check.CORNERS, Check.TRAVEL)


class Checked(NamedTuple):
    """What the checks of a program found.

    Attributes
    ----------
    findings
        In file order.
    coverage
        How far the checks came.
    steps
        Of the program; None where they were not worked out.
    contours, judged
        All contours, and those with no damaged block in or beside them and no block that never ends.
    compensation
        What the program's own compensation makes of it; None where it asks for none, or where it was not worked out.
    """

    findings: tuple[Finding, ...]
    coverage: Coverage
    steps: Steps | None
    contours: tuple[Contour, ...]
    judged: tuple[Contour, ...]
    compensation: "Offsetting | None" = None


def run_checks(program: Program, demands: Demands) -> Checked:
    """Run every check on a program, and blame the word that explains what they find."""
    checked = _every_check(program, demands)
    if not checked.findings:
        return checked
    names = program.toolpath.source.names
    if checked.steps is None:
        return checked._replace(findings=names.named(checked.findings))
    from sim.check.blame.proof import proved  # noqa: PLC0415 - a sound program has nobody to blame, and starts sooner
    from sim.check.blame.settle import settled  # noqa: PLC0415

    def again(text: str) -> tuple[Finding, ...]:
        return _every_check(parse_program(text, program.name, program.encoding, program.choices), demands).findings

    found = settled(program, checked.findings, checked.judged, again)
    return checked._replace(findings=names.named(proved(program, found, checked.judged, again)))


def _every_check(program: Program, demands: Demands) -> Checked:
    if any(telling(program.findings, TooLarge)):
        return _without_path(program, "reason-too-large")
    steps = interpolate(program.toolpath)
    excess = too_many_steps(program, steps)
    if excess:
        return _without_path(program, "reason-too-large", excess)
    contours = find_contours(program.toolpath, steps.corner_um)
    path = check_path(program, steps, contours, demands)
    findings = tuple(sorted([*program.findings, *in_codes(program.reading, path.findings)], key=file_order))
    counts = program.reading.counts
    decoded = counts.run - int(program.toolpath.is_endless.sum())
    states = (*_parser_states(program), *path.states)
    coverage = Coverage(counts.found, counts.whole, decoded, decoded, states)
    return Checked(findings, coverage, steps, contours, path.judged, path.compensation)


def _parser_states(program: Program) -> tuple[CheckState, ...]:
    damaged = program.reading.not_simulated.reason or "reason-damaged" if program.reading.damages else ""
    beyond = "reason-too-large" if any(telling(program.findings, TooLarge)) else damaged
    reasons = {Check.GRAMMAR: "", Check.ORDER: damaged}
    reasons |= dict.fromkeys((Check.BLOCKS, Check.PRINTED_ENDS, Check.HEADER), beyond)
    return tuple(state_of(program, name, reason) for name, reason in reasons.items())


def _without_path(program: Program, reason: str, more: list[Finding] | None = None) -> Checked:
    """Findings of a program whose geometry is not worth working out."""
    names = (*PATH_CHECKS, *((Check.COMPENSATION,) if compensation_of(program.toolpath) else ()))
    states = (*_parser_states(program), *(CheckState(name, "incomplete", reason) for name in names))
    counts = program.reading.counts
    coverage = Coverage(counts.found, counts.whole, 0, 0, states)
    return Checked(tuple(sorted([*program.findings, *(more or [])], key=file_order)), coverage, None, (), ())
