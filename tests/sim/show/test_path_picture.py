"""The picture of a path as it is programmed: drawn without a run, with all that the check knows."""

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from golden_pictures import assert_golden
from places import ROOT
from recorder import Recorder, recording_sheet
from runs import plain_scenario, run_folder

from parser.dialect.reader import Choices
from parser.program import parse_program, read_program
from sim.run.recording import NO_PIECES, Recording
from sim.setup.part import SIDES
from sim.setup.scenario import load_scenario
from sim.setup.taper import TaperSettings
from sim.show.draw.sheet import pixels
from sim.show.draw.style import DARK, Paint
from sim.show.pictures.cut.of_path import PATH, PathAlone, Programmed, cut_of_path, draw_path, programmed
from sim.show.pictures.cut.picture import draw_cut, layout_of
from sim.show.pictures.gallery import subject_of

PART = "B0B5000B5000GYL2 B9900B0B9900GXL1 B0B9900B9900GYL2 B9900B0B9900GXL3 B0B9900B9900GYL4 B0B5000B5000GYL4 DD"
OPEN = PART.replace("B9900B0B9900GXL3", "B9000B0B9000GXL3")
ENGINE = {"pymunk", "numba", "sim.table.motion", "sim.cut.remains", "sim.run.dryrun", "jinja2", "ezdxf"}


def of_text(text: str, **changes: object) -> Programmed:
    return programmed(parse_program(text, "part.3b"), plain_scenario(**changes))


def of_folder(name: str) -> Programmed:
    scenario = load_scenario(ROOT / "scenarios" / name)
    return programmed(read_program(scenario.program), scenario)


def recorded(shown: Programmed, language: str = "en") -> Recorder:
    return draw_path(recording_sheet(language=language), shown)


def test_golden() -> None:
    assert_golden(draw_path(pixels(800), of_text(OPEN)).image(), "path.png")


def test_golden_of_passes_dark_in_chinese() -> None:
    assert_golden(draw_path(pixels(800, DARK, "zh"), of_folder("rough-and-trim")).image(), "path-dark-zh.png")


def test_nothing_of_the_engine_is_loaded_for_it(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text(PART, "ascii")
    code = (
        "import sys\nfrom sim.cli import main\nsys.argv = ['drycut', 'draw', 'part.3b', '-o', 'part.png']\n"
        "try: main()\nexcept SystemExit as ended: print(ended.code, *sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True)
    written, told = done.stdout.splitlines()
    code, *modules = told.split()
    assert (written, code) == ("written: part.png", "0")
    assert set(modules) & ENGINE == set()


@pytest.mark.parametrize(("language", "said"), [("en", "checked, not run"), ("zh", "已检查，未运行")])
def test_it_says_that_nothing_ran_and_shows_what_the_check_finds(language: str, said: str) -> None:
    sound, wrong = recorded(of_text(PART), language), recorded(of_text(OPEN), language)
    assert any(said in text for text in sound.texts)
    assert not any(text.startswith("3B") for text in sound.texts)
    assert any(text.startswith("3B301") for text in wrong.texts)
    assert wrong.of("polyline", Paint.ACTUAL) == []


def test_leads_differ_from_edges() -> None:
    canvas = recorded(of_text(PART))
    leads = [one.at for one in canvas.of("polyline", Paint.LEAD)]
    assert len(leads) == 3  # in, out, and the sample of the legend
    assert "lead in or out" in canvas.texts
    edge_only = recorded(of_text(PART.partition(" ")[2].replace(" B0B5000B5000GYL4", "")))
    assert edge_only.of("polyline", Paint.LEAD) == []
    assert "lead in or out" not in edge_only.texts


def test_among_the_pictures_of_a_run_it_is_the_same() -> None:
    run = run_folder(ROOT / "scenarios" / "servo-trip")
    among = subject_of(Recording(run, NO_PIECES, None))  # type: ignore[arg-type]  # no picture of steps is asked for
    alone = PathAlone(of_folder("servo-trip"))
    first, second = (shown.draw(PATH, recording_sheet()) for shown in (among, alone))
    assert first is not None
    assert first.texts == second.texts
    assert len(first.drawn) == len(second.drawn)
    assert all(np.array_equal(a.at, b.at) for a, b in zip(first.drawn, second.drawn, strict=True) if a.what != "region")
    assert any(finding.code.startswith("3B4") for finding in run.findings)  # which the path does not know
    assert not any(text.startswith("3B4") for text in first.texts)


NAMELESS = "G92 X0 Y0\nG90\nG41 D0\nG01 X5000 Y0\nG03 X5000 Y0 I-5000 J0\nG40\nG01 X0 Y0\nM02\n"
"""A round hole by register D0, of which the program does not tell the value."""


def of_iso(text: str, **registers: float) -> Programmed:
    program = parse_program(text, "part.iso", choices=Choices(dialect="fast-wire", registers=tuple(registers.items())))
    return programmed(program, plain_scenario())


@pytest.mark.parametrize(
    ("language", "said", "contour"),
    [
        ("en", "contour alone: the offset is not known", "programmed contour"),
        ("zh", "补偿值未知，只画编程轮廓", "编程轮廓"),
    ],
)
def test_of_an_offset_that_nobody_tells_the_contour_is_drawn_alone(language: str, said: str, contour: str) -> None:
    canvas = recorded(of_iso(NAMELESS), language)
    assert any(said in text for text in canvas.texts)
    assert any(text.startswith("ISO500") for text in canvas.texts)
    assert contour in canvas.texts
    assert canvas.of("polyline", Paint.KERF) == canvas.of("polyline", Paint.LEAD) == []
    assert not any("0.000" in text for text in canvas.texts)


def test_of_an_offset_that_is_told_the_wire_and_its_kerf_are_drawn() -> None:
    canvas = recorded(of_iso(NAMELESS, D0=100.0))
    assert any("offset 0.1 mm left" in text for text in canvas.texts)
    assert not any("contour alone" in text for text in canvas.texts)
    assert canvas.of("polyline", Paint.KERF) != []


TWO_PASSES = """\
H1=.0099567
H2=.0072561
G92 X0 Y0
G90
G41 H1 G01 X.2
Y.2
X-.2
Y-.2
X.2
Y0.
G40 X0.
G42 H2 G01 X.2
Y-.2
X-.2
Y.2
X.2
Y0.
G40 X0.
M02
"""
"""A square opening in inches: there by H1, back by H2."""


def test_offsets_that_are_told_stand_in_the_note_to_a_tenth_of_a_micrometre() -> None:
    program = parse_program(TWO_PASSES, "part.iso", choices=Choices(dialect="mitsubishi", unit="inch"))
    texts = draw_path(recording_sheet(), programmed(program, plain_scenario())).texts
    assert any("offset 0.2529, 0.1843 mm left" in text for text in texts)
    assert {"pass 1, offset 0.253 mm", "pass 2, offset 0.184 mm"} <= set(texts)


def test_what_is_wrong_with_a_lean_is_found_before_anything_moves() -> None:
    slot = "B10000B0B10000GXL1\nB0B200B200GYL2\nB10000B0B10000GXL3\nB0B200B200GYL4\nDD\n"
    codes = [
        [finding.code for finding in of_text(slot, taper=TaperSettings(angle_rad=0.1, side=side)).findings]
        for side in (SIDES["left"], SIDES["right"])
    ]
    assert ["3B701" in each for each in codes] == [True, False]


@pytest.mark.parametrize(("language", "said"), [("en", "gap 0.9 mm"), ("zh", "缺口 0.9 mm")])
def test_the_gap_of_an_open_contour_is_drawn_with_its_length(language: str, said: str) -> None:
    """The side back is 9.0 mm long where it is 9.9 mm there: it ends 0.9 mm beside its start."""
    canvas = recorded(of_text(OPEN), language)
    (gap,) = [each.at for each in canvas.of("dashed", Paint.ERROR)]
    page = layout_of(recording_sheet(language=language), cut_of_path(of_text(OPEN), recording_sheet().say)).page
    assert np.hypot(*(gap[1] - gap[0])) / page.view.px_per_um == pytest.approx(900.0, abs=0.5)
    assert canvas.texts.count(said) == 1
    assert recorded(of_text(PART), language).of("dashed", Paint.ERROR) == []
    assert recorded(of_text(OPEN, may_stay_open=True), language).of("dashed", Paint.ERROR) == []


def test_a_gap_of_other_blocks_than_run_is_not_drawn() -> None:
    cut = cut_of_path(of_text(OPEN), recording_sheet().say)
    elsewhere = draw_cut(recording_sheet(), cut._replace(toolpath=of_text(PART).program.toolpath))
    assert elsewhere.of("dashed", Paint.ERROR) == []
    of_two = parse_program(PART.partition(" B0B9900B9900GYL2")[0] + " DD").toolpath
    assert draw_cut(recording_sheet(), cut._replace(toolpath=of_two, leads=None)).of("dashed", Paint.ERROR) == []
