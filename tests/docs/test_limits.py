"""The page of limits says what the code says."""

import re

from places import ROOT

from parser import files, units
from parser.drawing import plane
from parser.drawing.dxf import blocks, document
from parser.iso.path import flow
from parser.threeb import reader
from sim.base.workers import cluster
from sim.check import crossings, travel
from sim.check.blame import settle
from sim.jobs import shop
from sim.measure.compare import nearest, rings
from sim.setup.toml import reader as toml

PAGE = (ROOT / "docs" / "limits.md").read_text("utf-8")
VALUES = {
    "size of a file, or of the standard input": f"{files.MOST_MB} MB",
    "blocks of a program": reader.MOST_BLOCKS,
    "blocks that calls of subprograms run": flow.LONGEST,
    "a number of a block, µm": units.MAX_WORD_UM,
    "a start point or a printed end, µm from 0": units.MAX_PLACE_UM,
    "steps of 1 µm": travel.MAX_STEPS,
    "pairs of pieces of blocks compared for crossings": crossings.MOST_PAIRS,
    "blocks of a program in which one wrong word is looked for": settle.MOST_BLOCKS,
    "entities in the file": document.MOST_ENTITIES,
    "entities once blocks are inserted": document.MOST_ENTITIES,
    "blocks within blocks": blocks.MOST_NESTED,
    "lines and arcs, with those of ellipses and splines": plane.MOST_CURVES,
    "places on one spline": plane.MOST_PLACES,
    "coordinates, and how far an arc bulges, km": round(plane.FARTHEST_UM / 1e9),
    "closed contours of a program held against a drawing by `drycut compare`": rings.MOST_CONTOURS,
    "passes over these contours": rings.MOST_PASSES,
    "pairs of places and curves looked at for one comparison": nearest.MOST_HELD,
    "characters of a file": toml.MOST_CHARACTERS,
    "parts of a key with dots": toml.MOST_PARTS,
    "characters of one name in the way to a program's folder": shop.MOST_CHARACTERS,
    "wait for a scheduler, or for its first worker, s": cluster.MOST_WAIT_S,
}


def test_every_limit_of_the_page_is_that_of_the_code() -> None:
    rows = dict(re.findall(r"^\| ([^|]+?) \| ([\d,]+(?: MB)?) \|", PAGE, re.MULTILINE))
    assert rows == {name: f"{value:,}" if isinstance(value, int) else value for name, value in VALUES.items()}


def test_the_page_names_the_variable_that_sets_the_size() -> None:
    assert f"`{files.LIMIT_NAME}` in the environment" in PAGE


def test_what_the_page_of_the_check_says_of_size_is_the_same() -> None:
    check = (ROOT / "docs" / "check.md").read_text("utf-8")
    assert "limits.md" in check
    assert f"{crossings.MOST_PAIRS // 10**6} million pairs" in check
