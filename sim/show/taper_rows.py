"""A cut with a wire that leans in words for people: its rows on the terminal."""

import math

from parser.units import mm
from sim.cut.solids import Section, Solid, TiltedCut
from sim.setup.scenario import Scenario
from sim.show.texts import Words
from sim.show.texts.phrases import lasting


def taper_rows(cut: TiltedCut | None, scenario: Scenario, tell: Words) -> list[tuple[str, str]]:
    """Names and figures of the lean, of bottom and top, and of what comes free; none of an upright wire."""
    if cut is None:
        return []
    path, uv = cut.path, cut.path.uv_um()
    angle = "" if path.angle_rad is None else f"{math.degrees(path.angle_rad):.4g}°, "
    lean = tell("taper.lean-of", angle=angle, most=f"{math.degrees(path.lean_most_rad()):.3f}")
    heights = path.heights
    guides = tell(
        "taper.guides-assumed" if scenario.guides is None and scenario.machine.guides is None else "taper.guides-of",
        lower=f"{-mm(heights.lower_guide_um):g}",
        upper=f"{mm(heights.upper_guide_um - heights.work_um):g}",
    )
    return [
        (tell("taper.taper"), lean),
        (tell("taper.guides"), guides),
        (tell("taper.uv"), tell("taper.uv-of", side=f"{mm(uv.side_um):.3f}", corner=f"{mm(uv.corner_um):.3f}")),
        (tell("taper.time"), tell("taper.time-of", time=lasting(cut.axes.plan.duration_s))),
        *_faces(cut, tell),
        *((tell(f"taper.{solid.kind}"), _solid(solid, tell)) for solid in cut.solids),
    ]


def _faces(cut: TiltedCut, tell: Words) -> list[tuple[str, str]]:
    """The cut at the bottom and at the top."""
    faces = [(tell("taper.bottom"), cut.sections[0]), (tell("taper.top"), cut.sections[-1])]
    return [(name, _section(section, tell)) for name, section in faces]


def _section(section: Section, tell: Words) -> str:
    width, height = (mm(each) for each in (section.high_um - section.low_um).tolist())
    return tell(
        "taper.section-of",
        area=f"{section.programmed_um2 * 1e-6:.3f}",
        width=f"{width:.3f}",
        height=f"{height:.3f}",
        off=f"{section.off_um:.2f}",
    )


def _solid(solid: Solid, tell: Words) -> str:
    falls = tell("taper.drops" if solid.drops else "taper.stays")
    return tell("taper.solid-of", volume=f"{solid.volume_mm3:.2f}", mass=f"{solid.mass_g:.3g}", falls=falls)
