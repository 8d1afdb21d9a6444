"""The header's offset against the wire and against what the controller adds; several passes are not judged."""

import pytest

from parser.program import parse_program
from sim.check.path_checks import Demands, run_checks
from sim.setup.machine.machine import load_machine

HOLE = "B{r}B0B{r}GXL1\nB{r}B0B{j}GYNR1\nB{r}B0B{r}GXL3\n"
TABLE = load_machine("dk7740").table
ON_A_MACHINE = Demands(TABLE, (200_000.0, 250_000.0), offset_um=100.0)


def hole(radius: int) -> str:
    return HOLE.format(r=radius, j=4 * radius)


def codes(body: str, offset_mm: str, demands: Demands = ON_A_MACHINE) -> list[tuple[str, int]]:
    text = f"Conner R= 0.0 , Offset F= {offset_mm} , Name\n{body}DD"
    return [(f.code, f.column) for f in run_checks(parse_program(text), demands).findings]


@pytest.mark.parametrize(
    ("offset_mm", "found"),
    [
        ("0.00000", [("3B111", 17)]),
        ("0.10000", []),
        ("-0.10000", []),
        ("0.105", []),
        ("0.106", [("3B112", 17)]),
        ("0.070", [("3B112", 17)]),
    ],
)
def test_an_offset_is_held_against_the_wire(offset_mm: str, found: list[tuple[str, int]]) -> None:
    assert codes(hole(9900), offset_mm) == found
    assert codes(hole(9900) + "D\nB30000B0B30000GXL1\nD\n" + hole(4900), offset_mm) == found


@pytest.mark.parametrize("demands", [Demands(), Demands(offset_um=100.0), Demands(TABLE, (2e5, 2.5e5))])
def test_without_wire_and_machine_an_offset_is_not_judged(demands: Demands) -> None:
    assert codes(hole(9900), "0.0", demands) == codes(hole(9900), "0.3", demands) == []


@pytest.mark.parametrize(("offset_mm", "found"), [("0.0", []), ("0.1", [("3B506", 17)])])
def test_an_offset_that_the_controller_adds_besides_is_told(offset_mm: str, found: list[tuple[str, int]]) -> None:
    assert codes(hole(9900), offset_mm, Demands(added_um=100.0)) == found
    four = "B9900B0B9900B0GXL1\nB9900B0B39600B9900GYDNR1\nB9900B0B9900B0GXL3\n"
    assert ("3B506", 17) not in codes(four, offset_mm, Demands(added_um=100.0))


@pytest.mark.parametrize(
    "body",
    [
        hole(9820) + hole(9900),  # back to the hole between the passes
        hole(9820) + "D\n" + hole(9900),
        "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B39600GYSR4\nB9900B0B9900GXL3\n",  # there and back
        "B0B9900B9900GYL2\nB9900B0B9900GXL1\n",  # a parting cut
    ],
)
def test_several_passes_and_open_paths_are_not_judged(body: str) -> None:
    found = [code for code, _ in codes(body, "0.0") + codes(body, "0.3")]
    assert not {"3B111", "3B112"} & set(found)
