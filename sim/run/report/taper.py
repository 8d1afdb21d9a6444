"""``taper`` of the report: the cut of a wire that leans, its model and its figures."""

import math
from typing import TYPE_CHECKING, Annotated, TypedDict

from parser.documents import Count, Point, Size, one_of
from parser.units import mm
from sim.base.units import known, rounded
from sim.run.report.drawing import ComparisonEntry, comparison_entry
from sim.setup.taper import TaperSettings

if TYPE_CHECKING:  # the model of the report is read without what makes it
    from sim.cut.solids import Section
    from sim.run.dryrun import DryRun


class PlaneEntry(TypedDict):
    """A plane across the wire, or a guide of it."""

    plane: Annotated[str, one_of("lower-guide", "bottom", "program", "top", "upper-guide")]
    z_mm: float


class UVMostEntry(TypedDict):
    """The most that the upper guide is moved against the lower one: across walls, and at all."""

    side: Size
    corner: Size


class TiltedSectionEntry(TypedDict):
    """The cut at a height: the wire's way, and what comes free."""

    z_mm: Size
    programmed_area_mm2: Size
    box_mm: Point
    piece_area_mm2: Size | None
    max_deviation_um: Size


class VolumeEntry(TypedDict):
    """Volumes within the wire's way, and of what comes free."""

    programmed: Size
    piece: Size | None


class SolidEntry(TypedDict):
    """A piece through the whole work."""

    kind: Annotated[str, one_of("part", "slug")]
    volume_mm3: Size
    mass_g: Size
    larger: Annotated[str, one_of("top", "bottom", "neither")]
    drops: bool


class FourPulsesEntry(TypedDict):
    """How many pulses X and Y were given together, and U and V."""

    xy: Count
    uv: Count


class TaperEntry(TypedDict):
    """The cut of a wire that leans."""

    angle_deg: Size | None
    corner: Annotated[str, one_of("sharp", "cone")]
    planes: list[PlaneEntry]
    guides_assumed: bool
    pulses: FourPulsesEntry
    time_s: Size
    uv_most_um: UVMostEntry
    lean_most_deg: Size
    sections: list[TiltedSectionEntry]
    volume_mm3: VolumeEntry
    pieces: list[SolidEntry]
    drawing: ComparisonEntry | None


def taper_entry(run: "DryRun") -> TaperEntry | None:
    """``taper``; None of an upright wire."""
    cut, scenario = run.tilted, run.scenario
    if cut is None:
        return None
    heights, uv, settings = cut.path.heights, cut.path.uv_um(), scenario.taper or TaperSettings()
    planes: list[PlaneEntry] = [
        {"plane": "lower-guide", "z_mm": rounded(mm(heights.lower_guide_um))},
        {"plane": "bottom", "z_mm": 0.0},
        {"plane": "program", "z_mm": rounded(mm(heights.program_um))},
        {"plane": "top", "z_mm": rounded(mm(heights.work_um))},
        {"plane": "upper-guide", "z_mm": rounded(mm(heights.upper_guide_um))},
    ]
    angle_rad = cut.path.angle_rad
    return {
        "angle_deg": None if angle_rad is None else rounded(math.degrees(angle_rad)),
        "corner": settings.corner,
        "planes": planes,
        "guides_assumed": scenario.guides is None and scenario.machine.guides is None,
        "pulses": {"xy": cut.axes.pulses[0], "uv": cut.axes.pulses[1]},
        "time_s": rounded(cut.axes.plan.duration_s),
        "uv_most_um": {"side": rounded(uv.side_um), "corner": rounded(uv.corner_um)},
        "lean_most_deg": rounded(math.degrees(cut.path.lean_most_rad())),
        "sections": [_tilted_section(section) for section in cut.sections],
        "volume_mm3": {"programmed": rounded(cut.programmed_mm3), "piece": known(cut.piece_mm3)},
        "pieces": [
            {
                "kind": solid.kind,
                "volume_mm3": rounded(solid.volume_mm3),
                "mass_g": rounded(solid.mass_g),
                "larger": solid.larger,
                "drops": solid.drops,
            }
            for solid in cut.solids
        ],
        "drawing": comparison_entry(run.top),
    }


def _tilted_section(section: "Section") -> TiltedSectionEntry:
    """One entry of ``taper.sections[]``."""
    width, height = (section.high_um - section.low_um).tolist()
    return {
        "z_mm": rounded(mm(section.z_um)),
        "programmed_area_mm2": rounded(section.programmed_um2 * 1e-6),
        "box_mm": [rounded(mm(width)), rounded(mm(height))],
        "piece_area_mm2": known(section.piece_mm2),
        "max_deviation_um": rounded(section.off_um),
    }
