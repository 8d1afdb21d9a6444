"""Sound programs are met with silence, and decode to the ends that their CAM worked out by itself."""

import random

import pytest
from depth import cases
from sound import checks, off_um, sound_program

PROGRAMS, PARTS = len(cases(60, 3600)), 6


@pytest.mark.alike(2)
@pytest.mark.deep
@pytest.mark.parametrize("part", range(PARTS))
def test_sound_programs_have_no_findings(part: int) -> None:
    rng = random.Random(f"sound {part}")
    for _ in range(PROGRAMS // PARTS):
        program = sound_program(rng)
        found = [(finding.code, finding.line) for result in checks(program) for finding in result.findings]
        assert found == [], f"{program.name}\n{program.data.decode()}"


@pytest.mark.parametrize("part", range(3))
def test_exact_ends_are_those_of_the_cam_and_near_the_drawing(part: int) -> None:
    rng = random.Random(f"ends {part}")
    for _ in range(50):
        program = sound_program(rng)
        from_cam, from_drawing = off_um(program)
        assert from_cam < 0.05
        assert from_drawing < 12.0
