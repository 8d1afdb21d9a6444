"""Programs that ask for more than any table can do: numbers and steps beyond all bounds (3B206)."""

from collections.abc import Sequence

import numpy as np

from controller.stepping.steps import Steps
from controller.stepping.words import interpolate
from parser.dialect.at_block import at_block
from parser.findings.errors import ProgramError
from parser.findings.facts import TooLarge, telling
from parser.findings.findings import Finding
from parser.program import Program
from parser.text.source import Field

MAX_STEPS = 300_000_000
"""Steps that one run takes: 240 m of path, two months of cutting; a word damaged to nine digits asks for more."""


def too_many_steps(program: Program, steps: Steps) -> list[Finding]:
    """Finding 3B206 where a program makes more steps than any table does."""
    if len(steps) <= MAX_STEPS:
        return []
    row = int(np.argmax(steps.count))
    of = program.toolpath, program.lines
    found = at_block(*of, "3B206", row, Field.COUNT, what="too-many-steps", limit=MAX_STEPS)
    return [found.with_fact(TooLarge())]


def refusal(program: Program, findings: Sequence[Finding]) -> ProgramError:
    """Error of a program that asks for more than any table can do, of which one of the findings tells."""
    finding, _ = next(telling(program.toolpath.source.names.named(findings), TooLarge))
    return ProgramError(finding, excerpt=program.excerpt(finding.line))


def refuse_too_large(program: Program) -> None:
    """ProgramError (3B206) for a program with numbers, or more steps, than any table does."""
    if any(telling(program.findings, TooLarge)):
        raise refusal(program, program.findings)
    beyond = too_many_steps(program, interpolate(program.toolpath))
    if beyond:
        raise refusal(program, beyond)
