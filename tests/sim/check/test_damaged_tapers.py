"""Each finding of a lean in 100 damaged programs of 100, at sizes whose truth is a closed form, and none in sound ones.

Punches of 8 to 60 mm stand on their lower side, ten of each kind of damage; what each allows is worked out by hand from
the shift of a wall, H tan T, and the way of U and V, (W + H + S) tan T along walls and √2 as much at a corner of 90°.
"""

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from runs import machine, plain_scenario

from parser.findings.errors import ProgramError
from parser.program import load_program
from sim.run.prepare import prepare, tilt_findings
from sim.setup.machine.guides import Guides
from sim.setup.part import SIDES
from sim.setup.scenario import Scenario
from sim.setup.taper import TaperSettings, UpperProgram

Corner = tuple[int, int]
Case = tuple[bytes, Scenario]
W_MM, S_MM = 60.0, 100.0


def lines(*corners: Corner) -> str:
    """3B from place to place, from (0, 0)."""
    blocks, (x, y) = [], (0, 0)
    for to_x, to_y in corners:
        dx, dy = to_x - x, to_y - y
        quadrant = {(True, True): 1, (False, True): 2, (False, False): 3, (True, False): 4}[dx >= 0, dy >= 0]
        if not dx or not dy:
            quadrant = 1 if dx > 0 else 3 if dx < 0 else 2 if dy > 0 else 4
        count, axis = max((abs(dx), "X"), (abs(dy), "Y"))
        blocks.append(f"B{abs(dx)}B{abs(dy)}B{count}G{axis}L{quadrant}")
        x, y = to_x, to_y
    return "\n".join(blocks)


def punch(wide: int, high: int, header: str = "") -> bytes:
    """A rectangle about x = 0, whose lower side stands 5 mm over the thread point; counter-clockwise."""
    half = wide // 2
    way = lines((0, 5000), (half, 5000), (half, 5000 + high), (-half, 5000 + high), (-half, 5000), (0, 5000), (0, 0))
    return f"{header}{way}\nDD\n".encode()


def stepped(radius: int) -> bytes:
    """An L with an inside fillet, which a wall that grows makes smaller."""
    to_arc = lines((0, 5000), (12_000, 5000), (12_000, 12_000), (radius, 12_000))
    back = lines((-12_000, 0), (-12_000, -19_000), (0, -19_000), (0, -24_000))
    # From (radius, 12) clockwise about (radius, 12 + radius) to (0, 12 + radius); on to y = 24.
    up = 12_000 - radius
    return f"{to_arc}\nB0B{radius}B{radius}GYSR3\nB0B{up}B{up}GYL2\n{back}\nDD\n".encode()


def necked(neck: int) -> bytes:
    """A pocket behind a neck, which walls that grow close."""
    x = 10_500 - neck
    inner = [(x, 5000), (x, 10_000), (6500, 10_000), (6500, 15_000), (13_500, 15_000), (13_500, 11_000)]
    outer = [(10_500, 11_000), (10_500, 6000), (19_000, 6000), (19_000, 25_000), (-19_000, 25_000), (-19_000, 5000)]
    return f"{lines((0, 5000), *inner, *outer, (0, 5000), (0, 0))}\nDD\n".encode()


def scenario(rng: np.random.Generator, **settings: object) -> tuple[Scenario, float, float]:
    """A lean to the right, with tan T and the height."""
    degrees, height_mm = float(rng.uniform(1.0, 5.0)), float(rng.uniform(10.0, 60.0))
    taper = TaperSettings(math.radians(degrees), SIDES["right"])
    made = replace(plain_scenario(**settings), taper=taper, thickness_mm=height_mm)  # type: ignore[arg-type]
    return made, math.tan(math.radians(degrees)), height_mm


def size(rng: np.random.Generator) -> int:
    return 2 * int(rng.integers(4000, 30_000))


def of_guides(rng: np.random.Generator, share: float, **others: object) -> Case:
    """Travel of U and V of a share of what a corner needs."""
    made, tangent, height_mm = scenario(rng)
    needed_um = 2000.0 * (W_MM + height_mm + S_MM) * tangent  # from −u to +u at a corner: u along each axis
    return punch(size(rng), size(rng)), replace(made, guides=Guides(travel_u_um=needed_um * share, travel_v_um=1e6))


def turning(rng: np.random.Generator, share: float) -> Case:
    made, tangent, height_mm = scenario(rng)
    return stepped(round(1000.0 * height_mm * tangent * share)), made


def tilting(rng: np.random.Generator, share: float) -> Case:
    """Most angle of a share of the lean of a sharp corner, tan L = √2 tan T."""
    made, tangent, _ = scenario(rng)
    most = math.atan(math.sqrt(2.0) * tangent) * share
    return punch(size(rng), size(rng)), replace(made, guides=Guides(most_rad=most))


def travelling(rng: np.random.Generator, room_um: float) -> Case:
    """The lower guide goes W tan T inside of a punch that grows upwards; here outside, as it leans to the left."""
    made, tangent, _ = scenario(rng)
    wide, high = size(rng), size(rng)
    own = made.taper
    assert own is not None
    needed_mm = 1e-3 * (wide + room_um) + 2.0 * W_MM * tangent
    start = (0.5 * needed_mm, 200.0)
    table = machine(travel_x_mm=needed_mm, travel_y_mm=600.0)
    return punch(wide, high), replace(made, taper=own._replace(side=SIDES["left"]), machine=table, start_mm=start)


def paired(rng: np.random.Generator, *, is_off: bool, lacks: bool) -> Case:
    """Two contours; matched one block off, or one block short."""
    made, _, _ = scenario(rng)
    wide, high = size(rng), size(rng)
    upper = [f"{line}\n" for line in punch(wide - 2000, high).decode().splitlines()]
    if is_off:  # the side of the punch stands where half of the lower one is to be
        half = (wide - 2000) // 2
        way = lines((0, 5000), (40, 5000), (half, 5000), (half, 5000 + high), (-half, 5000 + high), (0, 5000), (0, 0))
        upper = [f"{way}\nDD\n"]
    if lacks:
        del upper[1]
    taper = TaperSettings(upper=UpperProgram("upper.3b", "".join(upper).encode()))
    return punch(wide, high), replace(made, taper=taper)


def headed(rng: np.random.Generator, *, is_widened: bool) -> Case:
    made, _, _ = scenario(rng)
    own = made.taper
    assert own is not None
    own = own._replace(angle_rad=math.radians(float(rng.uniform(15.0, 30.0))))
    assert own.angle_rad is not None
    offset = 0.1 / math.cos(own.angle_rad) if is_widened else 0.1
    head = "CAXAWEDM - Version 2.0, Name: part.3b\n"
    head += f"Conner R= 0.00000, Offset F= {offset:.5f}, Length= 90.000 mm\n"
    return punch(60_000, 60_000, head), replace(made, taper=own, thickness_mm=20.0)


def closing(rng: np.random.Generator, share: float) -> Case:
    """A neck of a share of what both walls move."""
    made, _, _ = scenario(rng)
    degrees = float(rng.uniform(0.6, 1.2))
    taper = TaperSettings(math.radians(degrees), SIDES["right"])
    moved_um = 2.0 * 40_000.0 * math.tan(math.radians(degrees))
    return necked(round(moved_um * share)), replace(made, taper=taper, thickness_mm=40.0)


def without_head(rng: np.random.Generator, travel_um: float) -> Case:
    made, _, _ = scenario(rng)
    return punch(size(rng), size(rng)), replace(made, guides=Guides(travel_u_um=travel_um, travel_v_um=1e6))


def found(case: Case) -> set[str]:
    """Codes that a run tells of the lean before anything moves."""
    text, made = case
    try:
        program = load_program(text, "part.3b", made.choices)
        ready = prepare(program, made)
    except ProgramError as error:
        return {each.code for each in (*error.others, error.finding)}
    return {each.code for each in (*ready.findings, *tilt_findings(ready, made)) if each.code.startswith("3B7")}


Make = Callable[[np.random.Generator], Case]
KINDS: dict[str, tuple[str, Make, Make]] = {
    "a fillet comes to nothing": ("3B701", lambda rng: turning(rng, 0.9), lambda rng: turning(rng, 1.1)),
    "U has too little travel": ("3B702", lambda rng: of_guides(rng, 0.99), lambda rng: of_guides(rng, 1.01)),
    "the wire tilts too far": ("3B703", lambda rng: tilting(rng, 0.99), lambda rng: tilting(rng, 1.01)),
    "the lower guide leaves the table": ("3B704", lambda r: travelling(r, -200.0), lambda r: travelling(r, 200.0)),
    "a block is missing above": (
        "3B705",
        lambda rng: paired(rng, is_off=False, lacks=True),
        lambda rng: paired(rng, is_off=False, lacks=False),
    ),
    "blocks are matched one off": (
        "3B706",
        lambda rng: paired(rng, is_off=True, lacks=False),
        lambda rng: paired(rng, is_off=False, lacks=False),
    ),
    "the offset is of an upright wire": (
        "3B708",
        lambda rng: headed(rng, is_widened=False),
        lambda rng: headed(rng, is_widened=True),
    ),
    "a neck closes above": ("3B709", lambda rng: closing(rng, 0.9), lambda rng: closing(rng, 1.15)),
    "the machine has no U": ("3B710", lambda rng: without_head(rng, 0.0), lambda rng: without_head(rng, 1e6)),
}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(12))
def test_each_damage_is_found_and_the_sound_program_is_silent(kind: str, seed: int) -> None:
    code, damaged, sound = KINDS[kind]
    assert code in found(damaged(np.random.default_rng(seed)))
    assert found(sound(np.random.default_rng(seed))) == set()
