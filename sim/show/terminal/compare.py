"""A comparison on the terminal: its figures, the worst places, what is wrong as a whole, the verdict."""

import numpy as np
from rich.table import Table

from parser.findings.catalogue import Language, remark_text
from parser.text.source import BlockNames
from parser.units import mm, mm_text
from sim.measure.compare.findings import by_block, by_entity, corner_places, worst_places
from sim.measure.compare.result import Comparison, WorstPlace
from sim.show.terminal.layout import paragraph, show, table
from sim.show.texts import Words

_MOST_CORNERS = 10
_SHOWN_UM = 5e-4  # what is not printed as 0.000
_SIDES = {1: "left", -1: "gouged"}


def print_comparison(of: Comparison, program: str, names: BlockNames, offset: str, language: Language) -> None:
    """Print a comparison to stdout; `offset` says how large it is and where it comes from.

    `program` is the name of its file, `names` are those of its blocks.
    """
    tell = Words(language)
    figures = table(tell("compare.title", program=program, drawing=of.drawing.name))
    for row in _rows(of, names, offset, tell):
        figures.add_row(*row)
    show(figures)
    show(_worst(of, names, tell))
    if of.unreachable:
        show(_corners(of, names, tell))
    for note in of.notes:
        paragraph(tell("compare.note", text=remark_text(note, language)), "cyan")
    for named in of.names:
        text = remark_text(named, language, names.other)
        paragraph(
            tell("compare.warning" if of.passes else "compare.error", text=text), "yellow" if of.passes else "red"
        )
    figures_of = {"most": _um(of.max_um), "tolerance": _um(of.request.tolerance_um)}
    verdict = tell("compare.pass" if of.passes else "compare.fail", **figures_of)
    paragraph(verdict, "bold green" if of.passes else "bold red")


def _um(length_um: float) -> str:
    """A deviation for people; a few thousandths of a µm are shown, since whole programs are that good."""
    return f"{length_um:,.3f} µm" if length_um < 1000.0 else f"{mm(length_um):,.3f} mm"


def _rows(of: Comparison, names: BlockNames, offset: str, tell: Words) -> list[tuple[str, str]]:
    there, back = (max(places, key=lambda place: place.deviation_um) for places in (by_block(of), by_entity(of)))
    return [
        (tell("compare.offset"), offset),
        (tell("compare.edge-from-drawing"), _most(there, names, tell)),
        (tell("compare.rms"), _um(of.edge_to_drawing.rms_um)),
        (tell("compare.drawing-from-edge"), _most(back, names, tell)),
        (tell("compare.rms"), _um(of.drawing_to_edge.rms_um)),
        (tell("compare.laid"), _laid(of, tell)),
    ]


def _most(place: WorstPlace, names: BlockNames, tell: Words) -> str:
    most = _um(place.deviation_um)
    return tell("compare.at-most", most=most, block=names(place.block), place=_xy(*place.where_um))


def _laid(of: Comparison, tell: Words) -> str:
    """How the drawing lies in the program's coordinates."""
    if not of.request.fitted:
        return tell("compare.laid-as-is")
    turn, (x, y), mirror = of.placement
    turned = f"{round(float(np.degrees(turn)), 4) + 0.0:.4f}"
    return tell("compare.laid-mirrored" if mirror else "compare.laid-turned", turn=turned, place=_xy(x, y))


def _heads(tell: Words, *names: str) -> tuple[str, ...]:
    return tuple(tell(f"compare.head-{name}") for name in names)


def _worst(of: Comparison, names: BlockNames, tell: Words) -> Table:
    heads = _heads(tell, "deviation", "side", "at", "block", "entity", "from")
    shown_table = table(tell("compare.worst"), heads, right=(0, 3))
    for place in worst_places(of):
        has_side = place.side in _SIDES and place.deviation_um >= _SHOWN_UM
        shown_table.add_row(
            _um(place.deviation_um),
            tell(f"compare.side-{_SIDES[place.side]}") if has_side else "",
            _xy(*place.where_um),
            names(place.block),
            _entity(of, place.entity),
            tell(f"compare.from-{place.measured_from}"),
        )
    return shown_table


def _corners(of: Comparison, names: BlockNames, tell: Words) -> Table:
    """Where the wire must leave something, the deepest first."""
    corners = sorted(corner_places(of), key=lambda corner: -corner.depth_um)
    counted = "counted" if of.request.sharp_corners == "fail" else "not-counted"
    title = tell(f"compare.corners-{counted}", number=f"{len(corners):,}")
    if len(corners) > _MOST_CORNERS:
        title = tell("compare.corners-deepest", title=title, most=_MOST_CORNERS)
    shown_table = table(title, _heads(tell, "left", "angle", "at", "block", "entity"), right=(0, 1, 3))
    for corner in corners[:_MOST_CORNERS]:
        shown_table.add_row(
            _um(corner.depth_um),
            f"{np.degrees(corner.angle_rad):.1f}°",
            _xy(*corner.where_um),
            names(corner.block),
            _entity(of, corner.entity),
        )
    return shown_table


def _entity(of: Comparison, number: int) -> str:
    if number < 0:
        return ""
    entity = of.drawing.entities[number]
    return f"{entity.kind} {entity.handle}"


def _xy(x_um: float, y_um: float) -> str:
    """A pair in millimetres, to the micrometre; never −0."""
    return ", ".join(mm_text(by) for by in (x_um, y_um))
