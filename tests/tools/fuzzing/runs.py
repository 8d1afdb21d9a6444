"""Targets `run` and `iso-run`: tiny programs dry-run, with all that a run can be asked for.

Now and then with pages and pictures.
"""

import random
from pathlib import Path

from places import SCENARIOS

from fuzzing import iso_text
from fuzzing.program_text import changed
from fuzzing.ran import answer_of, broken_by, leftovers, ran
from fuzzing.target import Input, Judged

_SIDES = ("L1", "L2", "L3", "L4")
_OPTIONS = (
    *(
        (),
        ("--kerf",),
        ("--interpolator", "card"),
        ("--past-stop", "--wire-lag", "20um"),
        ("--thickness", "2mm", "--kerf"),
    ),
    ("--offset", "0.05mm", "--side", "left", "--kerf"),
    ("--offset", "0.1mm,0.05mm", "--side", "right"),
    ("--kerf", "--drawing", "drawing.dxf", "--tolerance", "1mm"),
    ("--interpolator", "card", "--card-log", "part.log"),
    ("--offset", "D1=0.05mm", "--kerf"),
)
_WITH_PAGES = 25  # one in so many inputs


def make(rng: random.Random) -> Input:
    """A program of few short blocks: a rectangle, a circle, or whatever comes; then changed."""
    blocks = [_block(rng) for _ in range(rng.randint(1, 6))]
    kind = rng.random()
    if kind < 0.4:
        a, b = rng.randint(1, 400), rng.randint(1, 400)
        blocks = [f"B{a}B0B{a}GXL1", f"B0B{b}B{b}GYL2", f"B{a}B0B{a}GXL3", f"B0B{b}B{b}GYL4"]
    elif kind < 0.6:
        radius = rng.randint(1, 300)
        blocks = [f"B{radius}B0B{radius}GXL1", f"B{radius}B0B{4 * radius}GYNR1", f"B{radius}B0B{radius}GXL3"]
    text = "\n".join([*blocks, rng.choice(("DD", "D", "E", "")), ""])
    return (changed(rng, text) if rng.random() < 0.5 else text).encode()[:2000]


def make_iso(rng: random.Random) -> Input:
    """A rectangle or a hole of ISO, mostly compensated; then changed."""
    side, a, b = rng.choice(("G41 D1 ", "G42 D1 ", "")), rng.randint(1, 400), rng.randint(1, 400)
    around = rng.choice((f"X{a}\nY{b}\nX-{a}\nY-{b}", f"G03 I{a} J0", f"X{a}\nG02 X-{a} Y{a} I-{a}\nY-{a}"))
    stop = rng.choice(("", "", "M01\n", "M00\nG92 X500 Y0\n"))
    text = f"D1={rng.randint(0, 120)}\nG92 X0 Y0\nG91 {side}G01 Y{rng.randint(1, 200)}\n{around}\n{stop}G40 Y-90\nM02\n"
    return (iso_text.changed(rng, text) if rng.random() < 0.5 else text).encode()[:2000]


def judge(data: Input, number: int, folder: Path) -> Judged:
    """A run ends with a report that is JSON, or is refused in a line; it leaves nothing unfinished behind."""
    assert isinstance(data, bytes)
    (folder / "part.3b").write_bytes(data)
    machine = (SCENARIOS / "out-of-travel" / "machine.toml").read_text(encoding="utf-8")
    small = machine.replace("travel_x_mm = 100.0", "travel_x_mm = 4.0").replace(
        "travel_y_mm = 100.0", "travel_y_mm = 4.0"
    )
    (folder / "machine.toml").write_text(small, encoding="utf-8")
    (folder / "drawing.dxf").write_bytes((SCENARIOS / "round-hole" / "drawing.dxf").read_bytes())
    pages = ("-o", "out") if number % _WITH_PAGES == 1 else ("--json",)
    options = _OPTIONS[number % len(_OPTIONS)]
    done = ran(("run", "part.3b", "--machine", "machine.toml", *options, *pages), folder)
    broken = [*broken_by(done, folder, "json" if pages == ("--json",) else "text"), *leftovers(folder)]
    return Judged(answer_of(done, folder), broken, f"exit {done.returncode or 0}")


def _block(rng: random.Random) -> str:
    x, y = rng.randint(0, 300), rng.randint(0, 300)
    if rng.random() < 0.6:
        axis = "X" if x >= y else "Y"
        return f"B{x}B{y}B{max(x, y)}G{axis}{rng.choice(_SIDES)}"
    return f"B{x}B{y}B{rng.randint(1, 900)}G{rng.choice('XY')}{rng.choice(('NR', 'SR'))}{rng.randint(1, 4)}"
