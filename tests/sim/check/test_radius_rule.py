"""What the rule of 4B tears: sharp joints, marks against the turn, radii that vanish; tangent outlines are silent."""

import math
import random

import pytest
from sound_4b import outline_4b

from sim.check.file_check import Job, check_file
from sim.check.result import CheckResult
from sim.check.settings import CheckSettings

PUNCH = (  # docs/3b.md §6: rounded corners, and a half-round notch with fillets in the upper edge
    "B0B5000B5000B0GYL2 B30000B0B30000B0GXL1 B0B5000B5000B5000GYDNR4 B0B10000B10000B0GYL2 B5000B0B5000B5000GXDNR1 "
    "B9000B0B9000B0GXL3 B0B2000B2000B2000GYDNR2 B4000B0B8000B4000GYDDSR4 B2000B0B2000B2000GXDNR1 "
    "B9000B0B9000B0GXL3 B0B5000B5000B5000GYDNR2 B0B10000B10000B0GYL4 B5000B0B5000B5000GXDNR3 B0B5000B5000B0GYL4 DD"
)
SQUARE = (
    "B0B5000B5000B0GYL2 B10000B0B10000B0GXL1 B0B20000B20000B0GYL2 B20000B0B20000B0GXL3 B0B20000B20000B0GYL4 "
    "B10000B0B10000B0GXL1 B0B5000B5000B0GYL4 DD"
)


def checked(text: str, **settings: float) -> CheckResult:
    return check_file(Job("part.4b", text.encode(), CheckSettings(**settings)))


def told(text: str, **settings: float) -> list[tuple[str, int]]:
    return [(f.code, f.block) for f in checked(text, **settings).findings if f.code != "3B110"]


def test_tangent_outlines_are_silent() -> None:
    rng = random.Random(4)
    assert told(PUNCH, wire_diameter_um=180.0) == []
    assert all(told(outline_4b(rng).text, wire_diameter_um=180.0) == [] for _ in range(40))


def test_a_square_without_corner_arcs_is_named_with_what_its_sides_miss_each_other_by() -> None:
    (found,) = (f for f in checked(SQUARE, wire_diameter_um=180.0).findings if f.code != "3B110")
    assert (found.code, found.block, found.values["more"]) == ("3B214", 3, 3)
    assert found.values["shift"] == pytest.approx(100.0 * math.sqrt(2.0), abs=1e-6)
    assert told(SQUARE.replace("B0G", "G")) == []  # the same in 3B
    assert "3B214" not in [code for code, _ in told(SQUARE.replace("B20000B0G", "B20000G", 1))]  # one side of it


@pytest.mark.parametrize(("header", "offset_um"), [("", 100.0), ("Conner R= 0.0 , Offset F= 0.12 , Name\n", 120.0)])
def test_the_shift_is_told_for_the_offset_that_is_known(header: str, offset_um: float) -> None:
    (found,) = (f for f in checked(header + SQUARE).findings if f.code == "3B214")
    assert found.values["offset"] == pytest.approx(offset_um)
    assert found.values["shift"] == pytest.approx(offset_um * math.sqrt(2.0))


def test_a_mark_on_the_wrong_arc_is_named() -> None:
    assert told(PUNCH.replace("GYDDSR4", "GYDSR4")) == [("3B215", 8)]
    rng = random.Random(8)
    for _ in range(30):
        outline = outline_4b(rng)
        lines = outline.text.splitlines()
        at = rng.choice([at for at, line in enumerate(lines) if "R" in line])
        bare = lines[at].replace("DD", "D")
        lines[at] = bare.replace("D", "DD") if outline.corners[at // 2 - 1].is_convex else bare
        (found,) = (f for f in checked("\n".join(lines)).findings if f.code != "3B110")
        assert (found.code, found.block) == ("3B215", at + 1)
        assert found.values["ruled"] == ("D" if outline.corners[at // 2 - 1].is_convex else "DD")


def test_a_radius_that_the_offset_uses_up_is_an_error_on_the_side_of_the_waste_alone() -> None:
    rng = random.Random(16)
    for _ in range(30):
        outline = outline_4b(rng, (40.0, 160.0))
        # The concave arcs of a punch and the convex ones of a die have their centres in the waste.
        gone = [
            ("3B216", 3 + 2 * at)
            for at, corner in enumerate(outline.corners)
            if corner.is_convex == outline.is_die and corner.radius < 98.0
        ]
        doubtful = [3 + 2 * at for at, corner in enumerate(outline.corners) if abs(corner.radius - 100.0) <= 2.0]
        found = [one for one in told(outline.text, wire_diameter_um=180.0) if one[1] not in doubtful]
        assert found == gone, outline.text


@pytest.mark.parametrize("degrees", [10.0, 30.0, 60.0, 120.0])
def test_sides_miss_each_other_by_the_chord_of_their_turn(degrees: float) -> None:
    """A triangle of lines whose first corner turns by an angle: 2 f sin(angle / 2)."""
    x, y = round(20000 * math.cos(math.radians(degrees))), round(20000 * math.sin(math.radians(degrees)))
    axis = "X" if x > y else "Y"
    side = f"B{abs(x)}B{y}B{max(abs(x), y)}G{axis}L{1 if x > 0 else 2}"
    back_x, back_y = 20000 + x, y
    back = f"B{back_x}B{back_y}B{max(back_x, back_y)}G{'X' if back_x > back_y else 'Y'}L3"
    lines = ["B0B5000B5000GYL2", "B20000B0B20000GXL1", side, back, "B0B5000B5000GYL4"]
    found = checked("\n".join([*(line.replace("G", "B0G") for line in lines), "DD"])).findings
    (sharp,) = (f for f in found if f.code == "3B214")
    assert (sharp.block, sharp.values["other"], sharp.values["more"]) == (3, 2, 2)
    assert sharp.values["angle"] == pytest.approx(degrees, abs=0.01)
    assert sharp.values["shift"] == pytest.approx(200.0 * math.sin(math.radians(degrees) / 2.0), abs=0.02)


@pytest.mark.parametrize(("tilt", "is_sharp"), [(0.4, False), (0.6, True)])
def test_a_joint_is_a_tangent_to_half_a_degree(tilt: float, *, is_sharp: bool) -> None:
    # Long sides: whole µm tilt them by next to nothing.
    rise = round(200000 * math.tan(math.radians(tilt)))
    lines = ["B0B5000B5000GYL2", f"B200000B{rise}B200000GXL1", "B200000B0B200000GXL1"]
    lines += ["B0B90000B90000GYL2", "B400000B0B400000GXL3", f"B0B{90000 + rise}B{90000 + rise}GYL4", "B0B5000B5000GYL4"]
    found = checked("\n".join([*(line.replace("G", "B0G") for line in lines), "DD"])).findings
    (sharp,) = (f for f in found if f.code == "3B214")
    assert sharp.values["more"] == 3 + is_sharp


@pytest.mark.parametrize(("rise_um", "at"), [(11, 4), (12, 3)])
def test_short_sides_are_tangent_to_what_whole_um_tilt_them_more(rise_um: int, at: int) -> None:
    """A side of 1 mm may be tilted by 3 µm, 0.17°, more than half a degree: 0.63° is a tangent, 0.69° is none."""
    lines = ["B0B5000B5000GYL2", f"B1000B{rise_um}B1000GXL1", "B200000B0B200000GXL1", "B0B90000B90000GYL2"]
    lines += ["B201000B0B201000GXL3", f"B0B{90000 + rise_um}B{90000 + rise_um}GYL4", "B0B5000B5000GYL4"]
    assert told("\n".join([*(line.replace("G", "B0G") for line in lines), "DD"])) == [("3B214", at)]


OVERCUT = (  # rounded corners of 5 mm; it begins within an arc, and the last one cuts that half once more
    "B3000B4000B4000B0GYL3 B3000B4000B3000B5000GXDNR1 B20000B0B20000B0GXL3 B0B5000B5000B5000GYDNR2 "
    "B0B20000B20000B0GYL4 B5000B0B5000B5000GXDNR3 B20000B0B20000B0GXL1 B0B5000B5000B5000GYDNR4 "
    "B0B20000B20000B0GYL2 B5000B0B5000B5000GXDNR1 B0B3000B3000B0GYL2 DD"
)


@pytest.mark.parametrize("text", [OVERCUT, "B3000B0B3000B0GXL3 B5000B0B20500B5000GYDNR1 B3000B0B3000B0GXL1 DD"])
def test_an_outline_that_runs_on_along_its_arc_closes_in_a_tangent(text: str) -> None:
    assert "3B214" not in [code for code, _ in told(text)]


@pytest.mark.parametrize("mark", ["", "D"])
def test_an_arc_without_a_mark_has_none_against_its_turn(mark: str) -> None:
    assert "3B215" not in [code for code, _ in told(PUNCH.replace("GYDDSR4", f"GY{2 * mark}SR4"))]


@pytest.mark.parametrize("side", ["B20000B0B20000B0GXL3", "B0B20000B20000B0GYL4"])
def test_a_block_of_no_length_does_no_harm_to_its_outline(side: str) -> None:
    (sharp,) = (f for f in checked(SQUARE.replace(side, f"B0B0B0B0GXL1 {side}")).findings if f.code == "3B214")
    assert (sharp.block, sharp.values["other"], sharp.values["more"]) == (3, 2, 3)
