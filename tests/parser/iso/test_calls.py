"""Calls by family: programs made with their order of moves known, labels and block numbers alike by tens."""

import random

import pytest
from depth import cases

from parser.dialect.reader import Choices
from parser.program import Program, parse_program

FANUC_CASE = """%
O0001
N10 G21 G90 G40 G92 X0. Y0.
N20 M98 P0100
N30 M30
O0100
N70 G01 X10. Y0.
N80 G01 X20. Y0.
N90 G01 X20. Y20.
N100 G01 X5. Y20.
N110 G01 X0. Y10.
N120 G01 X0. Y0.
N130 M99
%
"""


class Made:
    """A program of subprograms that call each other, written in one family; `moves` are the X that it makes."""

    def __init__(self, rng: random.Random, family: str) -> None:
        self._rng, self._family = rng, family
        self._count = 0
        self._number = 0
        labels = rng.sample(range(2, 14), rng.randrange(1, 5))
        self._labels = [10 * label if rng.random() < 0.7 else label for label in labels]
        self._bodies: list[list[int | tuple[int, int]]] = [self._body(at) for at in range(len(labels) + 1)]
        self.moves = self._run(0)
        self.text = self._text()

    def _body(self, at: int) -> list[int | tuple[int, int]]:
        """Lengths of moves, and calls of later subprograms with how often."""
        body: list[int | tuple[int, int]] = []
        for _ in range(self._rng.randrange(1, 5)):
            if at < len(self._labels) and self._rng.random() < 0.45:
                body.append((self._rng.randrange(at, len(self._labels)) + 1, self._rng.choice([1, 1, 1, 2, 3])))
            else:
                self._count += 1
                body.append(1000 + self._count)
        if at == 0 and all(isinstance(one, int) for one in body):
            body.append((1, 1))
        return body

    def _run(self, at: int) -> list[int]:
        moves: list[int] = []
        for step in self._bodies[at]:
            moves += [step] if isinstance(step, int) else self._run(step[0]) * step[1]
        return moves

    def _text(self) -> str:
        fanuc = self._family == "fanuc"
        lines = ["%", "O0001"] if fanuc or self._rng.random() < 0.3 else ["%"]
        self._number = 10 if fanuc else 1000  # other families would take a block number behind the end for a label
        lines += [*self._lines(0, "G91 G92 X0 Y0"), "M30" if fanuc else "M02"]
        order = list(range(1, len(self._labels) + 1))
        self._rng.shuffle(order)
        for at in order:
            label = self._labels[at - 1]
            lines.append(f"{'O' if fanuc else 'N'}{label:04d}")
            lines += [*self._lines(at), "M99"]
        return "\n".join([*lines, "%", ""])

    def _lines(self, at: int, *head: str) -> list[str]:
        lines = [*head]
        for step in self._bodies[at]:
            if isinstance(step, int):
                lines.append(f"G01 X{step}")
            else:
                lines.append(self._call(*step))
        if self._family == "fanuc":
            return [self._numbered(line) for line in lines]
        return lines

    def _call(self, at: int, times: int) -> str:
        label = self._labels[at - 1]
        if self._family == "fanuc" and times > 1 and self._rng.random() < 0.5:
            return f"M98 P{times:04d}{label:04d}"
        return f"M98 P{label:04d}" + (f" L{times}" if times > 1 else "")

    def _numbered(self, line: str) -> str:
        number, self._number = self._number, self._number + 10
        return f"N{number} {line}"


def read(text: str, dialect: str) -> Program:
    return parse_program(text, choices=Choices(dialect=dialect, unit="mm"))


@pytest.mark.alike(2)
@pytest.mark.deep
@pytest.mark.parametrize("family", ["fanuc", "skd2", "sodick", "common"])
def test_calls_run_what_their_family_calls(family: str) -> None:
    for seed in cases(60, 10_000):
        made = Made(random.Random(f"{family} {seed}"), family)
        program = parse_program(made.text, choices=Choices(dialect=family))
        lengths = [round(length) for length in program.toolpath.length_um.tolist()]
        assert lengths == made.moves, made.text
        assert not [finding.code for finding in program.findings if finding.code == "ISO400"]


@pytest.mark.parametrize("dialect", ["fanuc", "common", "skd2"])
def test_a_program_number_is_called_before_a_block_in_the_middle_of_one(dialect: str) -> None:
    program = read(FANUC_CASE, dialect)
    assert program.toolpath.source.line.tolist() == [7, 8, 9, 10, 11, 12]
    assert ("assumed-calls", "P0100 → O0100") in [(one.what, one.taken) for one in program.reading.assumptions]


def test_fanuc_calls_no_block_and_does_not_run_on_into_another_program() -> None:
    missing = read("G91 G92 X0 Y0\nM98 P10\nM30\nN10 G01 X1.\nM99\n", "fanuc")
    assert [one.code for one in missing.findings if one.code == "ISO400"] == ["ISO400"]
    assert len(missing.toolpath) == 0
    unended = read("O1\nG91 G92 X0 Y0\nG01 X1.\nO2\nG01 X2.\nM99\n", "fanuc")
    assert unended.toolpath.source.line.tolist() == [3]
    assert "ISO109" in [one.code for one in unended.findings]
