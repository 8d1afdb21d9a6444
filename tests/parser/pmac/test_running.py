"""Motion programs with variables, branches, loops and calls, held against the same program written in Python.

The generator writes each statement twice, in the language of the card and in Python; Python's own interpreter says
where the moves end. Nothing of the reader takes part in that.
"""

import math
import random

import numpy as np
import pytest

from parser.findings.errors import ProgramError
from parser.program import Program, parse_program

HEAD = "I5113=10\nI5190=60000\n"


def read(body: str, before: str = "") -> Program:
    return parse_program(f"{HEAD}{before}OPEN PROG 1\nCLEAR\nLINEAR F60\n{body}\nCLOSE\n", "part.pmc")


def ends(program: Program) -> list[tuple[float, float]]:
    return [(round(x / 1000.0, 6), round(y / 1000.0, 6)) for x, y in program.toolpath.end_um.tolist()]


def halted(program: Program) -> tuple[str, str]:
    (found,) = [finding for finding in program.findings if finding.code == "PMC107"]
    return str(found.values["why"]), str(found.values["what"])


class Twice:
    """A random program in both languages."""

    def __init__(self, seed: int) -> None:
        self.rng = random.Random(seed)
        self.card: list[str] = []
        self.python: list[str] = []
        self.subs: list[tuple[str, str]] = []
        self.counters = 0

    def sum(self, depth: int = 0) -> tuple[str, str]:
        rng = self.rng
        kind = rng.random()
        if depth > 2 or kind < 0.3:
            number = f"{rng.uniform(0.1, 9.0):.3f}"
            return number, number
        if kind < 0.6:
            name = rng.choice(("P1", "P2", "Q3", "M7"))
            return name, f"v['{name}']"
        left, right = self.sum(depth + 1), self.sum(depth + 1)
        if kind < 0.8:
            sign = rng.choice("+-*")
            return f"({left[0]}{sign}{right[0]})", f"({left[1]}{sign}{right[1]})"
        if kind < 0.9:
            left, right = self.sum(3), self.sum(3)
            return f"(P1-{left[0]}*{right[0]}+Q3*2-1)", f"(v['P1']-{left[1]}*{right[1]}+v['Q3']*2-1)"
        name, other = rng.choice((("SIN", "sin(radians"), ("COS", "cos(radians"), ("ABS", "abs("), ("INT", "floor(")))
        close = "))" if "radians" in other else ")"
        return f"{name}({left[0]})", f"{other}({left[1]}{close}" if "radians" in other else f"{other}{left[1]})"

    def condition(self) -> tuple[str, str]:
        sign, other = self.rng.choice(((">", ">"), ("<", "<"), ("!>", "<="), ("!<", ">="), ("!=", "!=")))
        left, right = self.sum(1), self.sum(1)
        return f"{left[0]}{sign}{right[0]}", f"{left[1]}{other}{right[1]}"

    def put(self, indent: int, card: str, python: str) -> None:
        self.card.append(card)
        self.python.append("    " * indent + python)

    def statements(self, indent: int, count: int, depth: int = 0) -> None:
        self.put(indent, "DWELL0", "pass")
        for _ in range(count):
            self.statement(indent, depth)

    def statement(self, indent: int, depth: int) -> None:
        rng, kind = self.rng, self.rng.random()
        if kind < 0.35 or depth > 2:
            x, y = self.sum(), self.sum()
            self.put(indent, f"X({x[0]})Y({y[0]})", f"move({x[1]}, {y[1]})")
        elif kind < 0.55:
            name, value = rng.choice(("P1", "P2", "Q3", "M7")), self.sum()
            self.put(indent, f"{name}=({value[0]})%50 {name}={name}+1", f"v['{name}'] = ({value[1]}) % 50 + 1")
        elif kind < 0.7:
            first, second = self.condition(), self.condition()
            word, other = rng.choice((("AND", "and"), ("OR", "or")))
            apart = rng.choice((f"IF({first[0]} {word} {second[0]})", f"IF({first[0]})\n{word}({second[0]})"))
            self.put(indent, apart, f"if {first[1]} {other} {second[1]}:")
            self.statements(indent + 1, 2, depth + 1)
            if rng.random() < 0.5:
                self.put(indent, "ELSE", "else:")
                self.statements(indent + 1, 2, depth + 1)
            self.put(indent, "ENDIF", "pass")
        elif kind < 0.8:
            test, x = self.condition(), self.sum()
            self.put(indent, f"IF({test[0]}) X({x[0]})\nDWELL0", f"if {test[1]}: move({x[1]}, None)")  # no ELSE follows
        elif kind < 0.9:
            self.counters += 1
            name, times = f"P{100 + self.counters}", rng.randint(1, 4)
            self.put(
                indent,
                f"{name}=0\nWHILE({name}<{times})",
                f"v['{name}'] = 0\n{'    ' * indent}while v['{name}'] < {times}:",
            )
            self.statements(indent + 1, 2, depth + 1)
            self.put(indent + 1, f"{name}={name}+1", f"v['{name}'] += 1")
            self.put(indent, "ENDWHILE", "pass")
        else:
            number, x = rng.choice((500, 501)), self.sum()
            self.put(indent, f"CALL{number}.01 X({x[0]}) F60", f"v['Q124'] = {x[1]}\n{'    ' * indent}sub({number})")


@pytest.mark.alike(50)
@pytest.mark.parametrize("seed", range(150))
def test_random_programs_move_as_python_does(seed: int) -> None:
    twice = Twice(seed)
    twice.statements(0, 14)
    values = {"P1": 1.5, "P2": 2.0, "Q3": 3.0, "M7": 4.0}
    wanted: list[tuple[float, float]] = [(0.0, 0.0)]

    def move(x: float | None, y: float | None) -> None:
        last = wanted[-1]
        here = (last[0] if x is None else x, last[1] if y is None else y)
        if max(abs(here[0] - last[0]), abs(here[1] - last[1])) > 1e-9:
            wanted.append(here)

    def sub(number: int) -> None:
        if number == 500:
            move(values["Q124"] + 1.0, values["P1"])
        else:
            values["P2"] += 1.0
            move(None, values["Q124"])

    names = {"v": values, "move": move, "sub": sub, "radians": math.radians, "floor": math.floor}
    exec("\n".join(twice.python), names | {"sin": math.sin, "cos": math.cos})  # noqa: S102 - of the generator above
    called = (
        "OPEN PROG 500\nCLEAR\nN1000 READ(X)\nX(Q124+1)Y(P1)\nRETURN\nCLOSE\n"
        "OPEN PROG 501\nCLEAR\nX99\nN1000 READ(X)\nP2=P2+1\nY(Q124) RETURN\nX98\nCLOSE\n"
    )
    text = "\n".join(twice.card)
    if any(max(map(abs, end)) > 9000.0 for end in wanted):
        pytest.skip("beyond any table")
    if len(wanted) == 1:
        return
    program = read(text, f"{called}P1=1.5 P2=2 Q3=3\nM7->*\nM7=4\nB1R\n")
    assert [finding.code for finding in program.findings if finding.code in {"PMC101", "PMC107"}] == []
    assert np.abs(program.toolpath.end_um / 1000.0 - np.array(wanted[1:])).max() < 1e-6


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1+2*3", 7.0),
        ("(1+2)*3", 9.0),
        ("10-4-3", 3.0),
        ("-2*-3", 6.0),
        ("17%5", 2.0),
        ("(0-1)%360", 359.0),
        ("11%(0-10)", -9.0),
        ("6&3|8", 10.0),
        ("6^3", 5.0),
        ("SIN(30)", 0.5),
        ("ATAN(1)", 45.0),
        ("SQRT(2*8)", 4.0),
        ("INT(0-1.5)", -2.0),
        ("ABS(1-4)", 3.0),
        ("EXP(0)+LN(1)", 1.0),
        ("$1F", 31.0),
        ("P(P2+1)", 8.0),
    ],
)
def test_sums_are_what_the_manual_says(text: str, value: float) -> None:
    assert ends(read(f"X({text})", "P2=2 P3=8\n")) == [(value, 0.0)]


def test_angles_follow_i15_and_power_counts_in_radians() -> None:
    assert ends(read("X(10*SIN(Q1))", "I15=1 Q1=0.5\n")) == [(round(10 * math.sin(0.5), 6), 0.0)]
    power = "Coord[1].SegMoveTime=10\nCoord[1].FeedTime=60000\nopen prog 1\nlinear x(10*sin(0.5)) f60 // there\nclose\n"
    assert ends(parse_program(power, "a.pmc")) == [(round(10 * math.sin(0.5), 6), 0.0)]


def test_a_circle_of_chords_is_made_by_a_loop() -> None:
    body = "P1=0\nWHILE(P1<360)\nP1=P1+5\nX(10*COS(P1))Y(10*SIN(P1))\nENDWHILE"
    program = read(f"X10\n{body}")
    angle = np.radians(np.arange(0, 365, 5))
    assert np.abs(program.toolpath.end_um - 10_000.0 * np.column_stack([np.cos(angle), np.sin(angle)])).max() < 0.001
    assert set(program.toolpath.source.block.tolist()) == {1, 2}


def test_braces_and_double_signs_of_power_are_read() -> None:
    body = "p1 = 0\nwhile (p1 <= 2) {\np1 += 1\nif (p1 == 2) {\nx(p1)\n} else {\ny(p1)\n}\n}"
    program = parse_program(f"Coord[1].FeedTime=60000\nopen prog 1\nlinear f60\n{body}\nclose\n", "a.pmc")
    assert ends(program) == [(0.0, 1.0), (2.0, 1.0), (2.0, 3.0)]


def test_gosub_and_goto_go_to_labels_of_the_program() -> None:
    body = "GOSUB 100\nGOTO 200\nN100 X(P1)\nP1=P1+1\nRETURN\nX99\nN200 Y5\nGOSUB 100\nRETURN"
    assert ends(read(body, "P1=1\n")) == [(1.0, 0.0), (1.0, 5.0), (2.0, 5.0)]


def test_the_program_that_the_text_starts_is_the_one_that_runs() -> None:
    text = f"{HEAD}OPEN PROG 1\nCLEAR\nX1 F60\nCLOSE\nOPEN PROG 2\nCLEAR\nX2 F60\nCLOSE\n&1 B2 R\n"
    program = parse_program(text, "a.pmc")
    assert ends(program) == [(2.0, 0.0)]
    assert [finding.values["number"] for finding in program.findings if finding.code == "PMC105"] == [1]


@pytest.mark.alike(5)
@pytest.mark.parametrize(
    ("body", "why"),
    [
        ("X1\nX(P9)\nX3", ("pmac-no-value", "P9")),
        ("X1\nX(M11)\nX3", ("pmac-no-value", "M11")),
        ("X1\nM11=1\nX(M11)", ("pmac-no-value", "M11")),
        ("X1\nX(P50)", ("pmac-no-value", "P50")),
        ("X1\nP1=0\nWHILE(P1<1)\nP1=P1+0.1\nX(P1+1)\nENDWHILE", ("pmac-too-near", "1 = 1")),
        ("X1\nP1=0\nWHILE(P1<1)\nP2=1-P2\nENDWHILE\nX5", ("pmac-too-long", "")),
        ("X1\nWHILE(P3=3)\nX2\nX1\nENDWHILE", ("pmac-endless", "")),
        ("X1\nN5 X2\nX1\nGOTO5", ("pmac-endless", "")),
        ("X1\nIF(P3=3)\nX2", ("pmac-branch", "")),
        ("X1\nIF(P3=3)\nIF(P3=3) X2\nELSE X3\nENDIF", ("pmac-branch", "")),
        ("X1\nCALL77", ("pmac-no-program", "PROG 77")),
        ("X1\nGOSUB77", ("pmac-no-label", "N77")),
        ("X1\nP3=P9\nX(P3)", ("pmac-no-value", "P3")),
        ("X1\nP(P9)=1\nX(P3)", ("pmac-no-value", "P3")),
        ("X1\nIF(M11=1)\nP3=5\nENDIF\nX(P3)", ("pmac-no-value", "P3")),
    ],
)
def test_a_run_halts_where_the_text_does_not_say_how_it_goes_on(body: str, why: tuple[str, str]) -> None:
    plc = "P2=0 P3=3 P50=1\nOPEN PLC 2 CLEAR\nP50=2\nCLOSE\n"
    assert halted(read(body, plc)) == why


def test_what_moves_nothing_halts_nothing() -> None:
    body = "WHILE(M11=0) WAIT\nIF(M12=1)\nM13=1\nDWELL10\nENDIF\nDWELL(P99)\nTA(P98)\nF(P97)\nTM(P96)\nX1\nM20=P95\nX2"
    program = read(body)
    assert ends(program) == [(1.0, 0.0), (2.0, 0.0)]
    assert [finding.code for finding in program.findings] == []


def test_names_of_the_download_are_put_in_and_stand_where_they_are_written() -> None:
    before = "#define width 10\n#define far (width*2) ; twice\n#ifdef width\nP5=7\n#else\nP5=8\n#endif\n"
    program = read("X(far)Y(P5)\nX(width/4)\nX(P77+width)", before)
    assert ends(program) == [(20.0, 7.0), (2.5, 7.0)]
    (found,) = [finding for finding in program.findings if finding.code == "PMC107"]
    assert program.text[slice(*found.span)] == "X(P77+width)"


def test_a_name_of_an_included_file_halts_there_and_is_no_damage() -> None:
    program = read("X1\nX(width)\nX2", '#include "part.h"\n')
    assert ends(program) == [(1.0, 0.0)]
    assert halted(program) == ("pmac-included", "")
    assert "PMC101" not in {finding.code for finding in program.findings}
    with pytest.raises(ProgramError) as refused:
        parse_program("OPEN PLC 5 CLEAR\nP100=5\nDISABLE PLC5\nCLOSE\n", "plc.pmc")
    assert refused.value.finding.code == "PMC100"


@pytest.mark.parametrize(
    "body",
    [
        "X(" + "1+" * 5000 + "1)",
        "IF(P1=1" + " AND P1=1" * 5000 + ") X1",
        "IF(P1=1)\n" + "AND(P1=1)\n" * 5000 + "X1\nENDIF",
    ],
)
def test_a_sum_of_any_length_is_worked_out(body: str) -> None:
    assert len(ends(read(body, "P1=1\n"))) == 1


@pytest.mark.deeper
def test_names_that_double_one_another_are_bounded() -> None:
    doubled = "".join(f"#define a{n + 1} a{n} a{n}\n" for n in range(12))
    text = f"#define a0 X1\n{doubled}OPEN PROG 1\nCLEAR\nX2 F60\n{'a10 ' * 2000}\nCLOSE\n"
    assert halted(parse_program(text, "a.pmc"))[0] == "pmac-included"


def test_a_time_that_is_not_known_is_no_time_of_0() -> None:
    assert [finding.code for finding in read("TA0 TS(P99)\nX1\nZ(P98)\nX2").findings] == ["PMC106"]


def test_axes_beside_the_plane_are_counted_once_a_place() -> None:
    (found,) = [
        one for one in read("P1=0\nWHILE(P1<3)\nP1=P1+1\nX(P1)Z(P1)\nENDWHILE").findings if one.code == "PMC106"
    ]
    assert (found.values["word"], found.values["more"]) == ("Z1", 0)


def test_a_block_that_runs_many_times_is_counted_once() -> None:
    counts = read("P1=0\nWHILE(P1<5)\nX(P1+1)\nP1=P1+1\nENDWHILE\nX0").reading.counts
    assert counts == (2, 2, 2)
