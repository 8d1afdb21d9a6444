"""The job sheet: what it says of weight, time, offset and findings, against figures worked out by hand."""

import math
import re

import pytest
from replayed import recording_of
from runs import scenario_run

from parser.findings.codes import Severity
from sim.run.recording import NO_PIECES
from sim.run.report import build_report
from sim.setup.part import SIDES
from sim.setup.taper import TaperSettings
from sim.show.report_page.findings import MOST
from sim.show.report_page.sheet import Sheet, sheet_of

SQUARE = "B3000B0B3000GXL1\nB0B3000B3000GYL2\nB3000B0B3000GXL3\nB0B3000B3000GYL4\n"
TWO = f"{SQUARE}D\nB9000B0B9000GXL1\nD\n{SQUARE}DD\n"


def sheet(text: str, **changes: object) -> Sheet:
    recording = recording_of(text, **changes)
    return sheet_of(recording.run, build_report(recording.run), recording.pieces)


def fact(one: Sheet, name: str) -> str:
    return next(fact.value.en for fact in one.facts if fact.name.en == name)


@pytest.mark.parametrize("kerf", [True, False])
@pytest.mark.parametrize(("thickness_mm", "density_g_cm3"), [(40.0, 7.85), (100.0, 2.7), (10.0, 8.9)])
def test_weight_is_area_by_thickness_by_density_with_kerf_or_without(
    kerf: bool, thickness_mm: float, density_g_cm3: float
) -> None:
    made = sheet(TWO, kerf=kerf, thickness_mm=thickness_mm, density_g_cm3=density_g_cm3)
    # The kerf of 0.2 mm takes 0.1 mm from each side of a square of 3 mm; a drive may be off by 5 µm.
    grams = 2 * 2.8**2 * thickness_mm * density_g_cm3 / 1000.0
    told = re.fullmatch(r"2 parts, ([\d.]+) g", fact(made, "pieces"))
    assert told is not None
    assert float(told[1]) == pytest.approx(grams, rel=4 * 0.005 / 2.8, abs=0.05)


@pytest.mark.parametrize(("density_g_cm3", "assumed"), [(7.85, True), (2.7, False)])
def test_a_material_that_nobody_named_is_said_to_be_assumed(density_g_cm3: float, assumed: bool) -> None:
    work = fact(sheet(TWO, density_g_cm3=density_g_cm3), "work")
    assert f"{density_g_cm3:g} g/cm³" in work
    assert ("steel assumed" in work) is assumed


def test_a_wire_that_leans_is_set_at_the_control_by_the_sheet() -> None:
    taper = TaperSettings(math.radians(3.0), SIDES["left"], program_plane_um=2000.0)
    made = sheet(SQUARE + "DD\n", taper=taper, thickness_mm=20.0)
    # Guides 60 mm below the work and 100 mm above it: 180 mm apart, √2 as far at a sharp corner.
    most = 180.0 * math.tan(math.radians(3.0)) * math.sqrt(2.0)
    assert fact(made, "taper") == f"set 3°, upper end left of travel; U, V go up to {most:.3f} mm"
    guides = "guides assumed 60 mm below the work, 100 mm above it"
    assert fact(made, "planes and guides") == f"program 2 mm over the bottom; {guides}"
    assert fact(made, "time of four axes").endswith(" s")
    upright = {each.name.en for each in sheet(SQUARE + "DD\n").facts}
    assert not upright & {"taper", "planes and guides", "time of four axes"}


@pytest.mark.parametrize("kerf", [True, False])
def test_a_part_that_leans_weighs_what_its_solid_does(kerf: bool) -> None:
    big = SQUARE.replace("3000", "20000")
    taper = TaperSettings(math.radians(3.0), SIDES["right"])
    made = sheet(big + "DD\n", taper=taper, kerf=kerf)
    sides = [20.0 - 0.2 / math.cos(math.radians(3.0)) + by for by in (0.0, 80.0 * math.tan(math.radians(3.0)))]
    grams = 7.85e-3 * 40.0 / 3.0 * (sides[0] ** 2 + sides[1] ** 2 + sides[0] * sides[1])
    told = re.fullmatch(r"1 part, ([\d.]+) g", fact(made, "pieces"))
    assert told is not None
    assert float(told[1]) == pytest.approx(grams, rel=1e-3)


def test_pieces_that_could_not_be_worked_out_are_not_said_to_be_none() -> None:
    run = recording_of(TWO).run
    assert fact(sheet_of(run, build_report(run), NO_PIECES), "pieces") == "could not be worked out"
    assert fact(sheet("B3000B0B3000GXL1\nDD\n", may_stay_open=True), "pieces") == "none comes free"


def test_an_error_behind_more_warnings_than_the_page_shows_is_first() -> None:
    jagged = "B500B0B500GXL2\n" * (MOST + 1)  # a warning each
    recording = recording_of(f"{jagged}B500B0B490GXL1\nDD\n", may_stay_open=True)
    found = recording.run.findings
    assert [one.severity for one in found[:MOST]] == [Severity.WARNING] * MOST
    first, *others = sheet_of(recording.run, build_report(recording.run), recording.pieces).findings
    assert (first.code, first.severity, first.address) == ("3B208", "error", "findings")
    assert [one.address for one in others] == ["finding-1", "finding-2", "finding-3"]


def test_cutting_is_told_apart_from_jumps() -> None:
    with_jump, without = fact(sheet(TWO), "estimated time"), fact(sheet(f"{SQUARE}DD\n"), "estimated time")
    assert re.fullmatch(r"[\d.]+ (?:min|s).*, of it cutting .+", with_jump)
    assert "cutting" not in without


def test_an_offset_within_the_numbers_is_told_as_its_header_has_it() -> None:
    header = "CAXAWEDM -Version 2.0 , Name : a.3B\nConner R=  0.00000 , Offset F=  {f:.5f} ,Length= 12.000 mm\n"
    assert fact(sheet(header.format(f=0.11) + SQUARE + "DD\n"), "offset by the controller") == (
        "none: 0.110 mm is in the program already"
    )
    assert fact(sheet(header.format(f=0.0) + SQUARE + "DD\n"), "offset by the controller") == "none: path as written"


@pytest.mark.deeper
def test_passes_within_the_path_are_told_with_their_distances() -> None:
    run = scenario_run("plate")
    told = fact(sheet_of(run, build_report(run), NO_PIECES), "passes")
    # Its scenario asks for passes at 0.18, 0.12 and 0.1 mm, and a tab that is cut last, at the last of them.
    assert told == "4: 0.180, 0.120, 0.100, 0.100 mm from the edge"
    assert fact(sheet(TWO), "passes") == "1"
