"""The table's travel: held against where the steps lead, not against where the blocks should have ended."""

import pytest

from controller.stepping.steps import interpolate
from parser.findings.findings import Finding
from parser.program import parse_program
from sim.check.travel import travel_findings
from sim.setup.machine.machine import load_machine

TABLE = load_machine("dk7740").table
X_UM, Y_UM = TABLE.travel_x_mm * 1000.0, TABLE.travel_y_mm * 1000.0


def travel(text: str, start_um: tuple[float, float]) -> list[Finding]:
    program = parse_program(f"{text} DD")
    return travel_findings(program, interpolate(program.toolpath), TABLE, start_um)


# A line of 100 by 7 µm that counts on the short side has taken 86 steps in X when its 7 in Y are done.
SHORT_BY_14 = "B100B7B7GYL1"


@pytest.mark.parametrize(("from_edge_um", "beyond_um"), [(2086, []), (2085, [1.0]), (2000, [86.0])])
def test_a_block_starts_where_the_steps_of_the_one_before_ended(from_edge_um: int, beyond_um: list[float]) -> None:
    found = travel(f"{SHORT_BY_14} B2000B0B2000GXL1", (X_UM - from_edge_um, Y_UM / 2.0))
    assert [finding.values["by"] for finding in found] == beyond_um
    assert [(finding.block, finding.values["axis"]) for finding in found] == [(2, "X")] * len(beyond_um)


def test_a_block_that_is_stepped_too_far_is_seen_where_its_path_stays_within() -> None:
    # Mirrored, the 14 µm that are missing on the way out take the way back beyond the edge it came from.
    out_and_back = f"{SHORT_BY_14} B100B0B100GXL3"
    assert travel(out_and_back, (14.0, Y_UM / 2.0)) == []
    (finding,) = travel(out_and_back, (5.0, Y_UM / 2.0))
    assert (finding.block, finding.values["by"]) == (2, 9.0)


@pytest.mark.parametrize(("start_um", "axis"), [((0.0, Y_UM / 2.0), "X"), ((X_UM / 2.0, 0.0), "Y")])
def test_half_a_step_beyond_the_travel_is_within(start_um: tuple[float, float], axis: str) -> None:
    back = "B50B0B50GXL3" if axis == "X" else "B0B50B50GYL4"

    def start(from_edge_um: float) -> tuple[float, float]:
        return (from_edge_um, start_um[1]) if axis == "X" else (start_um[0], from_edge_um)

    assert travel(back, start(49.5)) == []
    (finding,) = travel(back, start(49.25))
    assert (finding.values["axis"], finding.values["by"]) == (axis, 0.75)
    assert (finding.values["x_mm"], finding.values["y_mm"]) == (TABLE.travel_x_mm, TABLE.travel_y_mm)


def test_the_first_block_that_leaves_is_named_with_the_axis_on_which_it_goes_farther() -> None:
    text = "B1000B0B1000GXL1 B3000B4000B4000GYL3 B1000B0B1000GXL3"
    (finding,) = travel(text, (500.0, 500.0))
    assert (finding.block, finding.values["axis"], finding.values["by"]) == (2, "Y", 3500.0)
