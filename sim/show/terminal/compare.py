"""A comparison on the terminal: its figures, the worst places, what is wrong as a whole, the verdict."""

import numpy as np
from rich.table import Table

from parser.findings.remarks import remark_text
from parser.text.block_names import BlockNames
from parser.units import mm
from sim.measure.compare.result import Comparison, WorstPlace
from sim.measure.compare.tables import by_block, by_entity, corner_places, worst_places
from sim.show.terminal.layout import paragraph, show, table

_MEASURED_FROM = {"edge": "cut edge", "drawing": "drawing", "lead": "lead"}
_MOST_CORNERS = 10
_SHOWN_UM = 5e-4  # what is not printed as 0.000
_SIDES = {1: "left", -1: "gouged", 0: ""}


def print_comparison(of: Comparison, program: str, names: BlockNames, offset: str) -> None:
    """Print a comparison to stdout; `offset` says how large it is and where it comes from.

    `program` is the name of its file, `names` are those of its blocks.
    """
    figures = table(f"{program} against {of.drawing.name}")
    for row in _rows(of, names, offset):
        figures.add_row(*row)
    show(figures)
    show(_worst(of, names))
    if of.unreachable:
        show(_corners(of, names))
    for note in of.notes:
        paragraph(f"note: {remark_text(note)}", "cyan")
    for named in of.names:
        text = remark_text(named, names=names.other)
        paragraph(f"{'warning' if of.passes else 'error'}: {text}", "yellow" if of.passes else "red")
    verdict = f"verdict: {'pass' if of.passes else 'fail'}, {_um(of.max_um)} of {_um(of.asked.tolerance_um)} allowed"
    paragraph(verdict, "bold green" if of.passes else "bold red")


def _um(length_um: float) -> str:
    """A deviation for people; a few thousandths of a µm are shown, since whole programs are that good."""
    return f"{length_um:,.3f} µm" if length_um < 1000.0 else f"{mm(length_um):,.3f} mm"


def _rows(of: Comparison, names: BlockNames, offset: str) -> list[tuple[str, str]]:
    there, back = (max(places, key=lambda place: place.deviation_um) for places in (by_block(of), by_entity(of)))
    return [
        ("offset", offset),
        ("edge from drawing", f"at most {_um(there.deviation_um)}, {_where(there, names)}"),
        ("  root mean square", _um(of.edge_to_drawing.rms_um)),
        ("drawing from edge", f"at most {_um(back.deviation_um)}, {_where(back, names)}"),
        ("  root mean square", _um(of.drawing_to_edge.rms_um)),
        ("drawing laid", _laid(of)),
    ]


def _where(place: WorstPlace, names: BlockNames) -> str:
    return f"block {names(place.block)} at {_xy(*place.where_um)} mm"


def _laid(of: Comparison) -> str:
    """How the drawing lies in the program's coordinates."""
    if not of.asked.fitted:
        return "as it is, not fitted"
    turn, (x, y), mirror = of.placement
    turned = f"turned {round(float(np.degrees(turn)), 4) + 0.0:.4f}°, shifted {_xy(x, y)} mm"
    return f"mirrored, {turned}" if mirror else turned


def _worst(of: Comparison, names: BlockNames) -> Table:
    heads = ("deviation", "side", "at, mm", "block", "entity", "measured from")
    shown = table("Worst places", heads, right=(0, 3))
    for place in worst_places(of):
        shown.add_row(
            _um(place.deviation_um),
            _SIDES[place.side] if place.deviation_um >= _SHOWN_UM else "",
            _xy(*place.where_um),
            names(place.block),
            _entity(of, place.entity),
            _MEASURED_FROM[place.measured_from],
        )
    return shown


def _corners(of: Comparison, names: BlockNames) -> Table:
    """Where the wire must leave something, the deepest first."""
    corners = sorted(corner_places(of), key=lambda corner: -corner.depth_um)
    counted = "counted" if of.asked.sharp_corners == "fail" else "not counted"
    deepest = f", the {_MOST_CORNERS} deepest" if len(corners) > _MOST_CORNERS else ""
    title = f"Sharp inside corners out of the wire's reach: {len(corners):,}, {counted}{deepest}"
    shown = table(title, ("left at least", "angle", "at, mm", "block", "entity"), right=(0, 1, 3))
    for corner in corners[:_MOST_CORNERS]:
        shown.add_row(
            _um(corner.depth_um),
            f"{np.degrees(corner.angle_rad):.1f}°",
            _xy(*corner.where_um),
            names(corner.block),
            _entity(of, corner.entity),
        )
    return shown


def _entity(of: Comparison, number: int) -> str:
    if number < 0:
        return ""
    entity = of.drawing.entities[number]
    return f"{entity.kind} {entity.handle}"


def _xy(x_um: float, y_um: float) -> str:
    """A pair in millimetres, to the micrometre; never −0."""
    return ", ".join(f"{round(mm(by), 3) + 0.0:.3f}" for by in (x_um, y_um))
