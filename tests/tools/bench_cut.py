"""Parts whose kerf and pieces cost most, for the benchmark: combs, squares, rasters, grids; holes in a drawing."""

import math
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import ezdxf


class CutPart(NamedTuple):
    """A part, and seconds of CPU that `--kerf` may add to its run: what it added before, and its goal."""

    name: str
    text: str
    before: str
    goal_s: float


def cut_parts() -> Iterator[CutPart]:
    """The parts that are run with and without `--kerf`."""
    yield CutPart("comb of 303 blocks, 4.8 m", comb(150, 30_000, 1_000), "13", 1.5)
    yield CutPart("1,000 squares in 5,000 blocks", squares(1_000, 1_000), "39", 4.0)
    yield CutPart("raster of 3,000 blocks, 38 m", raster(1_500, 25_000), "25", 4.0)
    yield CutPart("grid of 2 × 100 lines, 0.5 m", grid(100, 2_500, 50), "> 57", 3.0)
    yield CutPart("grid of 2 × 50 lines that frees 2,450 squares", grid(50, 25_000, 500), "35", 3.0)


def comb(teeth: int, high_um: int, wide_um: int) -> str:
    """Up and down again for each tooth, and back beneath."""
    blocks = [f"B0B{high_um}B{high_um}GYL{4 if tooth % 2 else 2}\n{_right(wide_um)}" for tooth in range(teeth)]
    back = wide_um * teeth
    return _program([*blocks, "B0B2000B2000GYL4", f"B{back}B0B{back}GXL3", "B0B2000B2000GYL2"])


def raster(lines: int, wide_um: int) -> str:
    """To and fro, 0.3 mm apart."""
    return _program([f"B{wide_um}B0B{wide_um}GXL{3 if line % 2 else 1}\nB0B300B300GYL2" for line in range(lines)])


def grid(lines: int, long_um: int, apart_um: int) -> str:
    """To and fro, then up and down across it."""
    along = [f"B{long_um}B0B{long_um}GXL{3 if line % 2 else 1}\nB0B{apart_um}B{apart_um}GYL2" for line in range(lines)]
    across = [f"B0B{long_um}B{long_um}GYL{2 if line % 2 else 4}\n{_right(apart_um)}" for line in range(lines)]
    return _program([*along, *across])


def squares(number: int, wide_um: int) -> str:
    """Squares in rows, a pause before and behind the jump to each next one."""
    row = math.isqrt(number) + 1
    w, back = wide_um, 2 * wide_um * (row - 1)
    square = f"{_right(w)}\nB0B{w}B{w}GYL2\nB{w}B0B{w}GXL3\nB0B{w}B{w}GYL4\nD"
    jumps = [f"B{back}B{2 * w}B{back}GXL2" if at % row == 0 else _right(2 * w) for at in range(1, number + 1)]
    return _program([f"{square}\n{jump}\nD" for jump in jumps])


def _right(by_um: int) -> str:
    return f"B{by_um}B0B{by_um}GXL1"


def _program(blocks: list[str]) -> str:
    return "\n".join([*blocks, "DD\n"])


def write_holes(path: Path, number: int) -> None:
    """A drawing of a square plate with so many holes of 6 mm, 12 mm apart."""
    row = math.ceil(math.sqrt(number))
    document = ezdxf.new(units=4)
    space, wide_mm = document.modelspace(), 12.0 * (row + 1)
    for at in range(number):
        space.add_circle((12.0 * (at % row + 1), 12.0 * (at // row + 1)), 3.0)
    space.add_lwpolyline([(0.0, 0.0), (wide_mm, 0.0), (wide_mm, wide_mm), (0.0, wide_mm)], close=True)
    document.saveas(path)
