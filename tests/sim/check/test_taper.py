"""A check that is told heights looks at both planes of a wire that leans; one that is not says so."""

from pathlib import Path

import pytest

from sim.check.file_check import Job, check_file
from sim.check.result import CheckResult
from sim.check.settings import CheckSettings
from sim.setup.machine.machine import load_machine
from sim.setup.taper import TaperSettings, UpperProgram

RAD = 0.017453292519943295
PUNCH = b"B0B5000B5000GYL2\nB10000B0B10000GXL1\nB0B20000B20000GYL2\nB20000B0B20000GXL3\n" + (
    b"B0B20000B20000GYL4\nB10000B0B10000GXL1\nB0B5000B5000GYL4\nDD\n"
)
LEANING = b"G92 X0 Y0\nG90\nG52 A3. G01 X0 Y5000\nX10000\nY25000\nX-10000\nY5000\nX0\nG50 X0 Y0\nM02\n"


def checked(program: bytes, name: str = "part.3b", **settings: object) -> CheckResult:
    return check_file(Job(name, program, CheckSettings(**settings)))  # type: ignore[arg-type]


def state(result: CheckResult) -> list[tuple[str, str]]:
    return [(each.state, each.reason) for each in result.coverage.checks if each.name == "check-taper"]


def test_without_a_height_a_leaning_program_is_checked_in_its_plane(tmp_path: Path) -> None:
    result = checked(LEANING, "part.iso", dialect="common")
    assert [finding.code for finding in result.findings] == ["ISO601"]
    assert (state(result), result.verdict) == ([("not asked", "reason-no-height")], "pass")


def test_with_a_height_a_sound_program_is_silent() -> None:
    for result in (
        checked(LEANING, "part.iso", dialect="common", thickness_mm=40.0),
        checked(PUNCH, taper=TaperSettings(3.0 * RAD), thickness_mm=40.0),
    ):
        assert {finding.code for finding in result.findings} <= {"ISO112"}
        assert state(result) == [("complete", "")]


def test_an_upright_program_is_checked_as_ever() -> None:
    plain, high = checked(PUNCH), checked(PUNCH, thickness_mm=40.0)
    assert (plain.findings, plain.coverage) == (high.findings, high.coverage)


@pytest.mark.parametrize(
    ("guides", "code"),
    [
        ("travel_u_mm = 20\ntravel_v_mm = 40\n", "3B702"),
        ("most_angle_deg = 4\n", "3B703"),
        ("travel_u_mm = 0\n", "3B710"),
    ],
)
def test_guides_of_the_machine_bound_the_lean(tmp_path: Path, guides: str, code: str) -> None:
    own = (Path("sim/setup/machine/dk7740.toml")).resolve().read_text("utf-8") + f"\n[guides]\n{guides}"
    (tmp_path / "mine.toml").write_text(own, "utf-8")
    machine = load_machine("mine.toml", folder=tmp_path)
    result = checked(PUNCH, taper=TaperSettings(3.0 * RAD), thickness_mm=40.0, machine=machine)
    assert [finding.code for finding in result.findings] == [code]


def test_an_upper_program_is_held_against_the_program() -> None:
    upper = PUNCH.replace(b"B20000", b"B16000").replace(b"B10000", b"B8000")
    taper = TaperSettings(upper=UpperProgram("upper.3b", upper))
    assert checked(PUNCH, taper=taper, thickness_mm=40.0).findings == ()
    short = TaperSettings(upper=UpperProgram("upper.3b", upper.replace(b"B8000B0B8000GXL1\n", b"", 1)))
    assert [finding.code for finding in checked(PUNCH, taper=short, thickness_mm=40.0).findings] == ["3B705"]
