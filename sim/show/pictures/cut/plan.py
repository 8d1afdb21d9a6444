"""The plan of a picture of a cut: its page, and what is to be said on it, before anything is drawn."""

from typing import Final, NamedTuple

from sim.show.draw import style
from sim.show.draw.layout import BESIDE_PLOT, IN_PLOT, Page, page_for
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.pictures.cut.legend import Entry, Seen, entries, finding_entries, rows_for
from sim.show.pictures.cut.lines import path_bounds_um, shown_bounds_um
from sim.show.pictures.cut.outlines import clamps_on, works_on
from sim.show.pictures.cut.size_lines import Extents, extents_of
from sim.show.pictures.cut.sizes import Shown, sizes_of_cut
from sim.show.pictures.cut.subject import Cut
from sim.show.pictures.cut.table import shows_border

_FOOT_ROWS: Final = 3  # rows of the legend in `style.FOOT`


class Plan(NamedTuple):
    """The page; what of the surroundings shows on it; the sizes and the lines of the largest; what the codes mean."""

    page: Page
    seen: Seen
    sizes: Shown
    extents: Extents | None
    codes: list[Entry]


def plan_of(sheet: Sheet[AnyCanvas], cut: Cut) -> Plan:
    """Lay out a page with room for its legend."""
    sizes, codes = sizes_of_cut(cut), finding_entries(cut, sheet.say)
    extents = extents_of(sizes, path_bounds_um(cut))
    bounds_um, inside = shown_bounds_um(cut), extents.margins() if extents else IN_PLOT
    page = page_for(bounds_um, sheet.width_px, inside=inside)
    seen = _seen(cut, page)
    rows = rows_for(len(entries(cut, page, sheet.say, seen, "")), len(codes))
    foot = style.FOOT + (rows - _FOOT_ROWS) * style.LEGEND_ROW
    page = page_for(bounds_um, sheet.width_px, BESIDE_PLOT._replace(bottom=foot), inside)
    return Plan(page, seen._replace(kerf_px=kerf_px(cut, page)), sizes, extents, codes)


def kerf_px(cut: Cut, page: Page) -> float:
    """The width that the kerf is drawn with."""
    return max(cut.kerf_um * page.view.px_per_um, style.KERF_WIDTH_MIN * page.unit)


def _seen(cut: Cut, page: Page) -> Seen:
    return Seen(
        work=bool(works_on(page, cut.bodies)),
        clamps=bool(clamps_on(page, cut.bodies)),
        travel=cut.travel_um is not None and shows_border(page, cut.travel_um),
        kerf_px=kerf_px(cut, page),
    )
