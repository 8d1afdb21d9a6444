"""Programs of two contours, written in every form that has words of them, and read back as what they were."""

import numpy as np
import pytest
import shapely
from depth import cases
from tilted_paths import random_pair

from parser.dialect.reader import Choices
from parser.findings.errors import SettingsError
from parser.geometry.curves import Curves, Floats
from parser.program import Program, load_program, paired
from parser.write.iso import iso_choices
from sim.make.convert import Converted, Refused, converted
from sim.make.wanted import Wanted

ROUND_ON_SQUARE = """D1=0.1
G92 X0. Y-15.
G90
G152 D1
G01 X0. Y-10. : G01 X0. Y-8.
G01 X10. Y-10. : G03 X5.657 Y-5.657 I0. J8.
G01 X10. Y0. : G03 X8. Y0. I-5.657 J5.657
G01 X10. Y10. : G03 X5.657 Y5.657 I-8. J0.
G01 X0. Y10. : G03 X0. Y8. I-5.657 J-5.657
G01 X-10. Y10. : G03 X-5.657 Y5.657 I0. J-8.
G01 X-10. Y0. : G03 X-8. Y0. I5.657 J-5.657
G01 X-10. Y-10. : G03 X-5.657 Y-5.657 I8. J0.
G01 X0. Y-10. : G03 X0. Y-8. I5.657 J5.657
G150
G01 X0. Y-15. : G01 X0. Y-15.
M02
"""
LOWER = b"""B0B5000B5000GYL2
B10000B0B10000GXL1
B0B20000B20000GYL2
B20000B0B20000GXL3
B0B20000B20000GYL4
B10000B0B10000GXL1
B0B5000B5000GYL4
DD
"""
UPPER = b"""B0B7000B7000GYL2
B8000B0B8000GXL1
B0B8000B16000GXNR4
B16000B0B16000GXL3
B0B16000B16000GYL4
B8000B0B8000GXL1
B0B7000B7000GYL4
DD
"""


def iso(dialect: str, *, keeps: bool = True) -> Wanted:
    return Wanted("iso", iso_choices(dialect), keeps=keeps)


THREE_B = Wanted("3b")


def read(text: str = ROUND_ON_SQUARE, dialect: str = "fast-wire") -> Program:
    return load_program(text.encode(), "part.iso", Choices(dialect=dialect))


def made(program: Program, wanted: Wanted) -> Program:
    """What is read back of a conversion."""
    done = converted(program, wanted)
    assert isinstance(done, Converted), done
    if wanted.iso is None:
        assert done.upper_data is not None
        return paired(load_program(done.data, "lower.3b"), load_program(done.upper_data, "upper.3b"))
    assert done.upper_data is None
    return load_program(done.data, "part.iso", Choices(dialect=wanted.iso.profile.name, registers=done.registers))


def places(curves: Curves, many: int = 9) -> Floats:
    """Places (k, 2) at even shares of each row, by turning its start about its centre."""
    share = np.linspace(0.0, 1.0, many)[None, :, None]
    line = curves.start_um[:, None] + share * (curves.end_um - curves.start_um)[:, None]
    angle = curves.start_angle_rad[:, None] + share[..., 0] * curves.sweep_rad[:, None]
    out = np.stack([np.cos(angle), np.sin(angle)], axis=2) * curves.radius_um[:, None, None]
    found: Floats = np.where(curves.is_arc[:, None, None], curves.center_um[:, None] + out, line)
    return found


def off_um(program: Program, other: Program) -> float:
    """How far two programs of two contours with the same blocks are apart, at most, in both planes."""
    (low, high), (other_low, other_high) = ((of.toolpath, of.toolpath.upper) for of in (program, other))
    assert high is not None
    assert other_high is not None
    pairs = ((low, other_low), (high, other_high))
    return max(float(np.hypot(*(places(a) - places(b)).reshape(-1, 2).T).max()) for a, b in pairs)


@pytest.mark.parametrize("dialect", ["fast-wire", "sodick"])
def test_two_contours_stay_what_they_are_in_dialects_with_a_colon(dialect: str) -> None:
    program = read()
    back = made(program, iso(dialect))
    assert off_um(back, program) < 1.0
    assert back.toolpath.compensation is not None
    assert back.toolpath.compensation.left_um.tolist() == program.toolpath.compensation.left_um.tolist()  # type: ignore[union-attr]


def test_two_files_of_3b_go_to_iso_and_back() -> None:
    program = paired(load_program(LOWER, "lower.3b"), load_program(UPPER, "upper.3b"))
    there = made(program, iso("fast-wire"))
    assert off_um(there, program) == 0.0
    assert off_um(made(there, THREE_B), program) == 0.0


def text_of(seed: int) -> str:
    """Two random closed contours as a text of fast wire, both begun and ended at their first place."""
    toolpath, upper, _ = random_pair(seed)
    lines = ["G92 X0. Y0.", "G90"]
    lines.append(" : ".join(_straight(of.start_um[0]) for of in (toolpath, upper)))
    lines += [" : ".join(_block(of, row) for of in (toolpath, upper)) for row in range(len(upper))]
    return "\n".join([*lines, "G01 X0. Y0.", "M02", ""])


def _straight(place_um: Floats) -> str:
    return "G01 X{:.3f} Y{:.3f}".format(*(np.rint(place_um) / 1000.0))


def _block(of: Curves, row: int) -> str:
    if not of.is_arc[row]:
        return _straight(of.end_um[row])
    i, j = (np.rint(of.center_um[row] - np.rint(of.start_um[row])) / 1000.0).tolist()
    x, y = (np.rint(of.end_um[row]) / 1000.0).tolist()
    return f"G0{3 if of.sweep_rad[row] > 0.0 else 2} X{x:.3f} Y{y:.3f} I{i:.3f} J{j:.3f}"


@pytest.mark.deep
@pytest.mark.parametrize("seed", [seed for seed in cases(4, 100) if seed != 12])  # 12 crosses its own lead
def test_random_contours_go_round_all_forms(seed: int) -> None:
    plain = read(text_of(seed))
    for wanted, bound_um in ((iso("sodick"), 1.0), (THREE_B, 3.0)):
        there = made(plain, wanted)
        assert off_um(there, plain) <= bound_um
        assert off_um(made(there, iso("fast-wire")), there) <= 1.0
    aside = made(plain, iso("mitsubishi"))
    assert not aside.toolpath.is_arc.any()
    low, high = aside.toolpath, aside.toolpath.upper
    assert high is not None
    for lines, drawn in ((low, plain.toolpath), (high, plain.toolpath.upper)):
        assert drawn is not None
        ring = shapely.LineString(places(drawn, 2000).reshape(-1, 2))
        assert shapely.distance(shapely.points(places(lines, 3).reshape(-1, 2)), ring).max() < 1.5
        assert lines.length_um.sum() == pytest.approx(drawn.length_um.sum(), rel=1e-4)
    assert off_um(made(aside, iso("fast-wire")), aside) <= 1e-6


@pytest.mark.parametrize("wanted", [iso("fast-wire", keeps=False), THREE_B])
def test_an_offset_is_worked_into_both_contours(wanted: Wanted) -> None:
    back = made(read(), wanted).toolpath
    assert back.compensation is None
    assert back.upper is not None
    assert np.abs(back.end_um).max() == pytest.approx(15_000.0)
    assert np.abs(back.end_um[1:8]).max() == pytest.approx(10_100.0, abs=1.5)
    assert np.hypot(*places(back.upper)[1:9].reshape(-1, 2).T) == pytest.approx(8_100.0, abs=1.5)


@pytest.mark.parametrize(
    ("wanted", "what"), [(iso("fanuc"), "two contours"), (iso("mitsubishi"), "no compensation beside U and V")]
)
def test_what_a_dialect_has_no_words_for_is_refused_by_name(wanted: Wanted, what: str) -> None:
    with pytest.raises(SettingsError, match=what):
        converted(read(), wanted)


def test_4b_has_no_two_contours() -> None:
    done = converted(read(), Wanted("4b"))
    assert isinstance(done, Refused)
    assert done.why == "leans"
