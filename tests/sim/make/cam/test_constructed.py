"""Two hundred drawings with one thing each that drawings of shops have: what is to be cut is, and the rest is said.

`tests/tools/constructed_drawings.py` wrote them with their truth. Each is made into a program and proved by a run.
"""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from depth import DEEP, spread
from places import ROOT
from runs import plain_scenario

from sim.make.cam.maker import MadeProgram, made_program
from sim.make.wanted import Wanted
from sim.measure.compare.rings import polygon
from sim.setup.making import Making
from sim.setup.picks import pick_of

FOLDER = ROOT / "tests" / "drawings"
TRUTH: dict[str, dict[str, Any]] = json.loads((FOLDER / "truth.json").read_text("utf-8"))
NAMES = sorted(TRUTH)
TRIED = NAMES if DEEP else [NAMES[at] for at in sorted(spread(20, len(NAMES)))]
WITHIN_MM = 0.05
AREA_SHARE, AREA_MM2 = 2e-3, 0.05
"""Bridged gaps move an edge by half of their width; a curve is drawn by chords in the truth."""


@pytest.mark.deep
@pytest.mark.parametrize("name", TRIED)
def test_a_constructed_drawing_is_cut_as_its_truth_says(name: str) -> None:
    wanted, path = TRUTH[name], FOLDER / f"{name}.dxf"
    done = made_program(path, making_of(wanted["options"], path), Wanted("3b"), plain_scenario())
    assert isinstance(done, MadeProgram), done
    assert done.is_proved
    assert sorted({left.why for left in done.plan.left_out}) == sorted(set(wanted["left"]))
    found = [(cut.figure.kind, polygon(cut.figure.contour)) for cut in done.plan.cuts]
    assert len(found) == len(wanted["contours"])
    for contour in wanted["contours"]:
        near = [
            ring
            for kind, ring in found
            if kind == contour["kind"]
            and np.hypot(*(np.array(ring.centroid.coords[0]) / 1e3 - contour["middle_mm"])) < WITHIN_MM
            and abs(ring.area * 1e-6 - contour["area_mm2"]) < AREA_MM2 + AREA_SHARE * contour["area_mm2"]
        ]
        assert len(near) == 1, contour


def making_of(options: dict[str, Any], path: Path) -> Making:
    making = Making(passes_um=(100.0,), common_edges=options.get("common_edges", False))
    if "pick" in options:
        making = making._replace(picks=tuple(pick_of(text, "test") for text in options["pick"]))
    return making._replace(gap_um=options.get("gap_um", making.gap_um), unit=options.get("unit", making.unit))
