"""What a replay shows of a wire that leans: its walls, and both ends of the wire where the program plane has come to.

The replay's steps and times are of the program plane. Partners of both contours are run by even shares (docs/taper.md),
so the place of a step in its block says where both ends of the wire are.
"""

from typing import TypedDict

from sim.run.dryrun import DryRun
from sim.show.html.walls import WallsEntry, walls_entry
from sim.show.replay.model import CurvesEntry
from sim.show.replay.tape import exact_columns


class LeanEntry(TypedDict):
    """A wire that leans: its walls, and the contours at the faces of the work, whose rows are run together.

    `block` is the row of the program that each of their rows is of. The program plane lies at `program_share` of the
    height, the guides `span` times as far apart as the faces.
    """

    walls: WallsEntry
    lower: CurvesEntry
    upper: CurvesEntry
    block: list[int]
    program_share: float
    span: float


def lean_entry(run: DryRun) -> LeanEntry | None:
    """The lean of a run; None of an upright wire."""
    walls = walls_entry(run.tilted)
    if run.tilted is None or walls is None:
        return None
    path = run.tilted.path
    heights = path.heights
    return {
        "walls": walls,
        "lower": exact_columns(path.ruled.lower),
        "upper": exact_columns(path.ruled.upper),
        "block": path.source_row.tolist(),
        "program_share": heights.program_um / heights.work_um,
        "span": heights.span_um / heights.work_um,
    }
