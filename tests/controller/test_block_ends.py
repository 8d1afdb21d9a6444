"""Ends of blocks moved aside, held against figures worked out by hand, and kinds of joints, against drawn corners."""

import numpy as np
import pytest

from controller.offset.joints import JointKind, aside_ends, joint_kinds
from parser.controller_words import Compensation, CompensationRules
from parser.program import parse_program
from parser.toolpath import Toolpath


def path_of(*words: str, start: tuple[float, float] = (0.0, 0.0)) -> Toolpath:
    """Toolpath of blocks in mm, absolute."""
    x, y = start
    return parse_program("\n".join([f"G92 X{x:f} Y{y:f}", "G90", *words, "M02"]), "part.iso").toolpath


def told(sides: list[int], by_um: float = 1000.0, **rules: str) -> Compensation:
    side = np.array(sides, dtype=np.int64)
    names = tuple("D1" if one else "" for one in sides)
    return Compensation(side, np.abs(side) * by_um, names, CompensationRules(**rules))  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("by_um", "left", "right"),
    [
        (100.0, (199910.8421, 300045.2865), (200089.1579, 299954.7135)),
        (10000.0, (191084.2113, 304528.6546), (208915.7887, 295471.3454)),
    ],
)
def test_the_figure_of_the_course_has_both_its_ends(
    by_um: float, left: tuple[float, float], right: tuple[float, float]
) -> None:
    path = path_of("G01 X200. Y300.", start=(72.0, 48.0))

    ends = aside_ends(path, told([1], by_um))

    assert path.length_um[0] == pytest.approx(282644.6532, abs=1e-4)
    assert ends.left_um[0] == pytest.approx(left, abs=1e-4)
    assert ends.right_um[0] == pytest.approx(right, abs=1e-4)


def test_the_end_of_an_arc_lies_aside_along_its_radius() -> None:
    path = path_of("G03 X0. Y10. I0. J5.")  # a half turn about (0, 5)

    ends = aside_ends(path, told([1]))

    assert ends.left_um[0] == pytest.approx((0.0, 9000.0), abs=1e-9)
    assert ends.right_um[0] == pytest.approx((0.0, 11000.0), abs=1e-9)


def test_left_and_right_stay_where_they_are_under_a_negative_register() -> None:
    path = path_of("G01 X10. Y0.")

    assert aside_ends(path, told([-1], -500.0)).left_um[0] == pytest.approx((10000.0, 500.0))


def test_blocks_without_a_side_have_no_ends_aside() -> None:
    ends = aside_ends(path_of("G01 X10. Y0.", "G01 X10. Y10."), told([0, 1]))

    assert np.isnan(ends.left_um[0]).all()
    assert not np.isnan(ends.left_um[1]).any()


# Each corner stands behind a set-up and a block along X; to the left of the path lies the offset.
CORNERS = {
    "X20. Y0.": JointKind.TANGENT,
    "X10. Y10.": JointKind.SHORTENED,
    "X0. Y5.": JointKind.SHORTENED,
    "X20. Y-5.": JointKind.LENGTHENED,
    "X10. Y-10.": JointKind.LENGTHENED,
    "X9. Y-10.": JointKind.INSERTED,
    "X0. Y0.": JointKind.INSERTED,
}


@pytest.mark.parametrize(("to", "kind"), CORNERS.items())
@pytest.mark.parametrize("by_um", [1000.0, np.nan])
def test_a_corner_is_joined_by_its_angle(to: str, kind: JointKind, by_um: float) -> None:
    path = path_of("G01 X0. Y0.", "G01 X10. Y0.", f"G01 {to}", start=(0.0, -5.0))

    assert joint_kinds(path, told([1, 1, 1], by_um)) == (JointKind.SET_UP, JointKind.NORMAL, kind)


def test_on_the_other_side_the_kinds_change_places() -> None:
    path = path_of("G01 X0. Y0.", "G01 X10. Y0.", "G01 X10. Y10.", start=(0.0, -5.0))

    assert joint_kinds(path, told([-1, -1, -1]))[2] == JointKind.LENGTHENED
    assert joint_kinds(path, told([1, 1, 1], -1000.0))[2] == JointKind.LENGTHENED


def test_a_family_that_goes_round_corners_inserts_an_arc_at_each() -> None:
    path = path_of("G01 X0. Y0.", "G01 X10. Y0.", "G01 X20. Y-5.", start=(0.0, -5.0))

    assert joint_kinds(path, told([1, 1, 1], outer="arc"))[2] == JointKind.INSERTED


def test_a_family_whose_set_up_ends_on_its_own_normal_goes_on_as_at_any_corner() -> None:
    path = path_of("G01 X0. Y0.", "G01 X10. Y0.", start=(0.0, -5.0))  # the way turns right, off the left side

    assert joint_kinds(path, told([1, 1], startup="own-normal"))[1] == JointKind.LENGTHENED


def test_set_up_and_cancel_lead_to_the_offset_path_and_back() -> None:
    path = path_of(*(f"G01 X{x}. Y0." for x in range(1, 6)))

    kinds = joint_kinds(path, told([0, 1, 1, 0, 0]))

    assert kinds == (JointKind.NONE, JointKind.SET_UP, JointKind.NORMAL, JointKind.CANCEL, JointKind.NONE)
