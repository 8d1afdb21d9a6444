"""A comparison on the terminal: its figures, the worst places, what is wrong as a whole, the verdict."""

import numpy as np
from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from parser.findings.remarks import remark_text
from parser.text.encoding import printable
from parser.units import mm
from sim.measure.compare.result import Comparison, WorstPlace
from sim.measure.compare.tables import by_block, by_entity, corner_places, worst_places

_MEASURED_FROM = {"edge": "cut edge", "drawing": "drawing", "lead": "lead"}
_MOST_CORNERS = 10
_SHOWN_UM = 5e-4  # what is not printed as 0.000
_SIDES = {1: "left", -1: "gouged", 0: ""}


def print_comparison(of: Comparison, program: str, offset: str) -> None:
    """Print a comparison to stdout; `offset` says how large it is and where it comes from."""
    console = Console(highlight=False)
    console.soft_wrap = not console.is_terminal
    table = Table(title=escape(f"{program} against {of.drawing.name}"), title_justify="left", show_header=False)
    table.title_style = "bold"
    table.add_column(style="dim")
    table.add_column()
    for name, value in _rows(of, offset):
        table.add_row(name, escape(value))
    console.print(table)
    console.print(_worst(of))
    if of.unreachable:
        console.print(_corners(of))
    for note in of.notes:
        console.print(Text(f"note: {printable(remark_text(note))}", style="cyan"))
    for named in of.names:
        console.print(
            Text(f"{'warning' if of.passes else 'error'}: {remark_text(named)}", style="yellow" if of.passes else "red")
        )
    verdict = f"verdict: {'pass' if of.passes else 'fail'}, {_um(of.max_um)} of {_um(of.asked.tolerance_um)} allowed"
    console.print(Text(verdict, style="bold green" if of.passes else "bold red"))


def _um(length_um: float) -> str:
    """A deviation for people; a few thousandths of a µm are shown, since whole programs are that good."""
    return f"{length_um:,.3f} µm" if length_um < 1000.0 else f"{mm(length_um):,.3f} mm"


def _rows(of: Comparison, offset: str) -> list[tuple[str, str]]:
    there, back = (max(places, key=lambda place: place.deviation_um) for places in (by_block(of), by_entity(of)))
    return [
        ("offset", offset),
        ("edge from drawing", f"at most {_um(there.deviation_um)}, {_where(there)}"),
        ("  root mean square", _um(of.edge_to_drawing.rms_um)),
        ("drawing from edge", f"at most {_um(back.deviation_um)}, {_where(back)}"),
        ("  root mean square", _um(of.drawing_to_edge.rms_um)),
        ("drawing laid", _laid(of)),
    ]


def _where(place: WorstPlace) -> str:
    return f"block {place.block:,} at {_xy(*place.where_um)} mm"


def _laid(of: Comparison) -> str:
    """How the drawing lies in the program's coordinates."""
    if not of.asked.fitted:
        return "as it is, not fitted"
    turn, (x, y), mirror = of.placement
    turned = f"turned {round(float(np.degrees(turn)), 4) + 0.0:.4f}°, shifted {_xy(x, y)} mm"
    return f"mirrored, {turned}" if mirror else turned


def _worst(of: Comparison) -> Table:
    table = Table(title="Worst places", title_justify="left", title_style="bold")
    for name, justify in (("deviation", "right"), ("side", "left"), ("at, mm", "left"), ("block", "right")):
        table.add_column(name, justify=justify)  # type: ignore[arg-type]
    table.add_column("entity")
    table.add_column("measured from")
    for place in worst_places(of):
        table.add_row(
            _um(place.deviation_um),
            _SIDES[place.side] if place.deviation_um >= _SHOWN_UM else "",
            _xy(*place.where_um),
            f"{place.block:,}",
            escape(_entity(of, place.entity)),
            _MEASURED_FROM[place.measured_from],
        )
    return table


def _corners(of: Comparison) -> Table:
    """Where the wire must leave something, the deepest first."""
    corners = sorted(corner_places(of), key=lambda corner: -corner.depth_um)
    counted = "counted" if of.asked.sharp_corners == "fail" else "not counted"
    shown = f", the {_MOST_CORNERS} deepest" if len(corners) > _MOST_CORNERS else ""
    title = f"Sharp inside corners out of the wire's reach: {len(corners):,}, {counted}{shown}"
    table = Table(title=title, title_justify="left", title_style="bold")
    for name, justify in (("left at least", "right"), ("angle", "right"), ("at, mm", "left"), ("block", "right")):
        table.add_column(name, justify=justify)  # type: ignore[arg-type]
    table.add_column("entity")
    for corner in corners[:_MOST_CORNERS]:
        table.add_row(
            _um(corner.depth_um),
            f"{np.degrees(corner.angle_rad):.1f}°",
            _xy(*corner.where_um),
            f"{corner.block:,}",
            escape(_entity(of, corner.entity)),
        )
    return table


def _entity(of: Comparison, number: int) -> str:
    if number < 0:
        return ""
    entity = of.drawing.entities[number]
    return printable(f"{entity.kind} {entity.handle}")


def _xy(x_um: float, y_um: float) -> str:
    """A pair in millimetres, to the micrometre; never −0."""
    return ", ".join(f"{round(mm(by), 3) + 0.0:.3f}" for by in (x_um, y_um))
