"""A program for a wire that leans: its offset in the program plane, its words in ISO, and which way its walls go.

In the program plane a wire that leans by T cuts as an upright one whose kerf is 1 / cos T as wide (EDM_NC, g24.cpp). So
a plan is made for that wire, and all else of it is as of an upright cut.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from parser.controller_words import Taper
from parser.findings.catalogue import Remark
from parser.geometry.curves import CurveKind, Curves
from parser.units import from_mm
from sim.make.cam.model import CannotCutError, CutPlan, FigureCut, PassCut, Refusal
from sim.make.wanted import Wanted
from sim.measure.compare.rings import orientation
from sim.setup.making import Making
from sim.setup.scenario import Scenario
from sim.setup.taper import TaperSettings, refuse_one_height


def lean_of(scenario: Scenario) -> TaperSettings | None:
    """The lean of all contours that are made for a scenario; None where the wire is upright."""
    taper = scenario.taper
    return taper if taper is not None and taper.angle_rad else None


def cosine_of(scenario: Scenario) -> float:
    """Of the angle by which the wire leans."""
    taper = lean_of(scenario)
    return 1.0 if taper is None or taper.angle_rad is None else float(np.cos(taper.angle_rad))


def in_plane(scenario: Scenario) -> Scenario:
    """The scenario with the upright wire that cuts as its own does in the program plane."""
    wire, cosine = scenario.wire, cosine_of(scenario)
    if cosine == 1.0:
        return scenario
    return replace(scenario, wire=replace(wire, spark_gap_um=wire.reach_um / cosine - wire.radius_um))


def wall_shift_um(scenario: Scenario) -> float:
    """The most that a wall lies beside its contour at any height; 0 of an upright wire."""
    taper = lean_of(scenario)
    if taper is None or taper.angle_rad is None:
        return 0.0
    plane_um = taper.program_plane_um
    return max(plane_um, from_mm(scenario.thickness_mm) - plane_um) * float(np.tan(taper.angle_rad))


def height_over_plane_um(scenario: Scenario) -> float:
    """From the plane of the program to the top of the work."""
    return from_mm(scenario.thickness_mm) - _plane_um(scenario)


def _plane_um(scenario: Scenario) -> float:
    return 0.0 if scenario.taper is None else scenario.taper.program_plane_um


def leaning(making: Making, scenario: Scenario, *, says_angle: bool) -> Making:
    """What is asked for, its offsets as they are in the program plane; the angle says what the top is.

    Where the language does not say the angle, several passes run one way: the control leans the wire to one side of
    travel, and on the way back that is the other side of the contour.
    """
    cosine = cosine_of(scenario)
    if cosine == 1.0:
        return making
    making = making._replace(upper=None)
    layers = tuple(wish._replace(passes_um=_widened(wish.passes_um, cosine)) for wish in making.layers)
    returning = making.returning if says_angle else "one-way"
    return making._replace(passes_um=_widened(making.passes_um, cosine), layers=layers, returning=returning)


def _widened(passes_um: tuple[float, ...], cosine: float) -> tuple[float, ...]:
    return tuple(by_um / cosine for by_um in passes_um)


def refuse_upright_ways(making: Making, wanted: Wanted, scenario: Scenario) -> None:
    """CannotCutError for what is known of upright wires alone, SettingsError for two contours at one height."""
    is_two = making.upper is not None
    if is_two:
        refuse_one_height(_plane_um(scenario), from_mm(scenario.thickness_mm))
    if lean_of(scenario) is None and not is_two:
        return
    misfits = {
        "taper-kept": (wanted.keeps and not is_two) or (bool(making.passes_um) and not all(making.passes_um)),
        "taper-lag": bool(making.lag_um),
        "taper-common": making.common_edges,
        "taper-coreless": making.no_core,
        "upper-4b": is_two and wanted.language == "4b",
        "upper-tab": is_two and bool(making.tab_um or making.slug_tab_um or making.overcut_um),
    }
    for why, is_wanted in misfits.items():
        if is_wanted:
            raise CannotCutError(Refusal(why))


def angle_words(plan: CutPlan, curves: Curves) -> Taper | None:
    """The lean of the rows of a draft, in the words of ISO; None of an upright wire.

    The first row of a pass sets it up, and the last row of what leads away takes it back.
    """
    taper = plan.taper
    if taper is None or taper.angle_rad is None:
        return None
    side = np.zeros(len(curves), dtype=np.int64)
    rows = [sided for visit in plan.visits for pass_ in visit.passes_of(plan.cuts[visit.cut]) for sided in _rows(pass_)]
    side[curves.kind != CurveKind.JUMP] = np.array(rows, dtype=np.int64) * int(taper.side)
    return Taper(side, np.full(len(curves), taper.angle_rad))


def _rows(pass_: PassCut) -> Iterator[int]:
    """±1 of each row of a pass on which the wire leans, −1 on the way back; 0 of the last one that leads away."""
    side = -1 if pass_.is_back else 1
    number = len(pass_.into) + len(pass_.along) + len(pass_.out)
    yield from [side] * (number - 1)
    yield 0 if len(pass_.out) else side


def grows_upwards(cut: FigureCut, taper: TaperSettings) -> bool:
    """Whether what is cut is larger at the top: to the left of a way that runs counter-clockwise lies its inside."""
    return orientation(cut.passes[0].along) != int(taper.side)


def lean_notes(plan: CutPlan, wanted: Wanted) -> tuple[Remark, ...]:
    """Which figures are larger at the top and at the bottom, and that a language has no word of the angle."""
    taper = plan.taper
    if taper is None or taper.angle_rad is None:
        return ()
    upwards = [cut.figure.number for cut in plan.cuts if grows_upwards(cut, taper)]
    downwards = [cut.figure.number for cut in plan.cuts if cut.figure.number not in upwards]
    angle_deg = f"{np.degrees(taper.angle_rad):g}"
    notes = [
        Remark(f"taper-{name}", {"number": len(figures), "figures": _named(figures)})
        for name, figures in (("upwards", upwards), ("downwards", downwards))
        if figures
    ]
    if wanted.iso is None:
        notes.append(Remark("taper-beside", {"angle": angle_deg, "side": f"lean-{taper.side.name.lower()}"}))
    return tuple(notes)


_MOST_NAMED = 10


def _named(figures: list[int]) -> str:
    named = ", ".join(map(str, sorted(figures)[:_MOST_NAMED]))
    return f"{named} …" if len(figures) > _MOST_NAMED else named
