"""An offset path in 3B and 4B: centre and count are chosen together, so that it lies near at any angle."""

import random

import pytest
from depth import cases
from sound_4b import outline_4b

from parser.program import parse_program
from sim.make.convert import Converted, converted
from sim.make.wanted import Language, Wanted
from sim.run.prepare import as_run
from sim.setup.part import SIDES, Offset, OffsetPass

H23 = """B3870B1013B3870GXL3 B978B3738B3738GYL2 B581B152B872GXNR1 B7843B4354B7843GXL3 B291B525B402GYNR2
B1691B8110B8110GYL3 B587B123B609GXNR2 B7271B49B7271GXL4 B4B600B214GYNR3 B4221B5037B5037GYL1 B460B385B537GYNR4
B978B3738B3738GYL2 B3870B1013B3870GXL1 DD"""


def off_um(text: str, by_um: float, side: str, language: Language) -> float:
    path = as_run(parse_program(text), Offset((OffsetPass(by_um),), SIDES[side]))
    made = converted(path, Wanted(language, offset_um=by_um))
    assert isinstance(made, Converted), (made, text)
    return made.off_um


@pytest.mark.parametrize("language", ["3b", "4b"])
def test_a_slanted_outline_is_written_within_a_step(language: Language) -> None:
    """It was refused, 4.959 µm off: rounding added up from fillet to fillet."""
    assert off_um(H23, 90.0, "right", language) <= 1.2


def test_fillets_at_any_angle_are_written_within_the_bound() -> None:
    """Of 600, 118 were refused, and the worst accepted was 3.0 µm off; then the 86th was, by 1.66."""
    rng = random.Random(23)
    worst = []
    for _ in cases(8, 1000):
        text, by_um, side = (
            outline_4b(rng, (300.0, 3000.0)).text,
            rng.uniform(50.0, 150.0),
            rng.choice(["left", "right"]),
        )
        worst += [off_um(text, by_um, side, language) for language in ("3b", "4b")]
    assert max(worst) <= 1.2
    assert sorted(worst)[len(worst) // 2] <= 0.8
