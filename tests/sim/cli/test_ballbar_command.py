"""``drycut ballbar`` as a user meets it, its document against its schema, and its picture."""

import itertools
import json
import re
from dataclasses import replace
from functools import cache
from importlib import resources
from pathlib import Path

import click
import numpy as np
import pytest
from circles import SAMPLES, measured, moved_out, perfect, with_play, with_spikes
from command import run_command, run_inside, without_progress
from golden_pictures import assert_golden, compare
from jsonschema import Draft202012Validator
from PIL import Image
from places import ROOT

from parser.controller_words import Axis
from parser.findings.catalogue import LANGUAGES, Language
from sim.base.progress import silent
from sim.cli.ballbar import ballbar as command
from sim.run.ballbar.circle import Ballbar, circle_test, document, run_test
from sim.run.ballbar.figures import SENSES, MeasuredTurn
from sim.setup.machine.machine import load_machine
from sim.show.draw.chart import RING_SIZES, RINGS, ring_for
from sim.show.draw.style import LIGHT, Paint
from sim.show.pictures.ballbar import draw_ballbar
from sim.show.terminal.batch import print_ballbar
from sim.table.losses import Loss

SMALL = ("ballbar", "--radius", "1mm")
PAGE = (ROOT / "docs" / "ballbar.md").read_text(encoding="utf-8")
SCHEMA = json.loads((ROOT / "docs" / "ballbar.schema.json").read_text(encoding="utf-8"))
LOSS = Loss("lost-steps", Axis.X, 0, 1.25, -12.0, -300.0, 40.0)


def complaints(result: object) -> list[str]:
    Draft202012Validator.check_schema(SCHEMA)
    return [f"{error.json_path}: {error.message}" for error in Draft202012Validator(SCHEMA).iter_errors(result)]


@cache
def with_known_errors(x_um: float = 6.0, y_um: float = 4.0, out_um: float = -0.8) -> Ballbar:
    """A test whose paths have backlash, spikes and too small a radius."""
    out = np.full(SAMPLES + 1, out_um)
    ccw, cw = (moved_out(with_spikes(with_play(perfect(sense), x_um, y_um), 1.5), out) for sense in SENSES)
    test = circle_test(load_machine("dk7740"), 50_000.0, 8000.0)
    return Ballbar(test, 8000.0, (ccw, cw), (), measured(ccw, cw))


def tripped() -> Ballbar:
    """A test whose second turn did not go round."""
    done = with_known_errors()
    stands = MeasuredTurn(-1, done.turns[1].points_um[:9])
    return replace(done, turns=(done.turns[0], stands), losses=((-1, LOSS._replace(kind="trip")),), measured=None)


def test_a_test_prints_its_figures_and_parts() -> None:
    done = run_command(*SMALL)
    printed = done.stdout.decode()
    assert (done.returncode, without_progress(done.stderr)) == (0, b"")
    for name in ("circularity G(b)", "radial deviation F, max", "hysteresis H", "backlash", "spike", "interpolation"):
        assert name in printed
    assert "30 mm/min" in printed
    assert printed.endswith("verdict: pass\n")


@pytest.mark.deeper
def test_json_fits_its_schema_and_is_the_same_bytes_each_time() -> None:
    first, second = (run(*SMALL, "--feed", "60mm/min", "--json") for run in (run_command, run_inside))
    assert first.stdout == second.stdout
    result = json.loads(first.stdout)
    assert complaints(result) == []
    assert (result["radius_um"], result["feed_um_s"]) == (1000, 1000.0)
    assert 0.5 < result["circularity_um"] < 5.0


@pytest.mark.parametrize(
    "make", [with_known_errors, tripped, lambda: replace(with_known_errors(), losses=((1, LOSS),))]
)
def test_every_outcome_fits_the_schema(make: object) -> None:
    assert complaints(document(make(), 5.0)) == []


@pytest.mark.deeper
def test_the_schema_refuses_a_key_more_or_less() -> None:
    result = document(with_known_errors(), None)
    for node in (result, result["figures"], result["figures"]["cw"], result["parts"], result["parts"]["reversals"][7]):
        for key in list(node):
            value = node.pop(key)
            assert complaints(result), key
            node[key] = value
        node["surplus"] = 1
        assert complaints(result)
        del node["surplus"]
    assert complaints(result) == []


def test_every_key_is_documented() -> None:
    def keys(node: object) -> set[str]:
        if isinstance(node, dict):
            return set(node) | {key for value in node.values() for key in keys(value)}
        return {key for entry in node for key in keys(entry)} if isinstance(node, list) else set()

    text = re.sub(r"^```.*?^```$", "", PAGE, flags=re.MULTILINE | re.DOTALL)
    named = set(re.findall(r"\w+", " ".join(re.findall(r"`([^`]+)`", text))))
    assert keys(document(replace(with_known_errors(), losses=((1, LOSS),)), None)) - named == set()


def test_options_are_documented() -> None:
    written = re.findall(r"^\| `(--?\w+)", PAGE, flags=re.MULTILINE)
    assert set(written) == {option.opts[0] for option in command.params if isinstance(option, click.Option)}


def test_figures_and_parts_are_documented_by_the_names_they_are_printed_with(
    capsys: pytest.CaptureFixture[str],
) -> None:
    print_ballbar(with_known_errors(), None, "en")
    names = re.findall(r"^│ ([a-z][^│]*?) +│ .*\d", capsys.readouterr().out, flags=re.MULTILINE)
    assert "hysteresis H" in names
    assert [name for name in names[3:] if f"| {name} |" not in PAGE] == []


def test_a_tolerance_decides_the_exit_code() -> None:
    loose, tight = (run_inside(*SMALL, "--tolerance", limit) for limit in ("10um", "0.1um"))
    assert (loose.returncode, tight.returncode) == (0, 1)
    assert b"of 10.00" in loose.stdout
    assert tight.stdout.decode().splitlines()[-1].startswith("verdict: fail, G(b) ")


def test_what_is_lost_fails_the_test_and_is_named(capsys: pytest.CaptureFixture[str]) -> None:
    lost = replace(with_known_errors(), losses=((1, LOSS),))
    assert not lost.passes(None)
    print_ballbar(lost, None, "en")
    told = " ".join(capsys.readouterr().out.split())
    assert "ccw: the X stepper lost −12 µm at 1.250 s, −0.300, 0.040 mm from the start" in told


def test_a_turn_that_does_not_go_round_has_no_figures(capsys: pytest.CaptureFixture[str]) -> None:
    assert not tripped().passes(1000.0)
    print_ballbar(tripped(), 1000.0, "en")
    printed = capsys.readouterr().out
    assert "cw: the X servo tripped on a following error of −12.0 µm" in printed
    assert "no figures: the table does not go round, cw" in printed
    assert document(tripped(), None)["circularity_um"] is None


@pytest.mark.deeper
def test_output_is_a_picture_or_a_folder(tmp_path: Path) -> None:
    assert run_inside(*SMALL, "-o", tmp_path / "a" / "plot.PNG").returncode == 0
    assert [path.name for path in (tmp_path / "a").iterdir()] == ["plot.PNG"]
    done = run_inside(*SMALL, "-o", tmp_path / "b", "--json")
    assert sorted(path.name for path in (tmp_path / "b").iterdir()) == ["ballbar.json", "ballbar.png"]
    assert (tmp_path / "b" / "ballbar.json").read_bytes() == done.stdout
    assert (tmp_path / "b" / "ballbar.png").read_bytes() == (tmp_path / "a" / "plot.PNG").read_bytes()


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (["--radius", "201mm"], "--radius in mm (travel of DK7740 class, stepper drives) is 201; it must lie between"),
        (["--radius", "50"], "'50' is no length"),
        (["--feed", "500"], "'500' is no speed"),
        (["--feed", "1000m/s"], "--feed in mm/min is 60000000"),
        (["--tolerance", "0um"], "--tolerance"),
        (["-o", f"{__file__}/x.png"], "is a file"),
        (["--nonsense"], "No such option"),
    ],
)
def test_bad_use_exits_2_with_one_clear_line(tmp_path: Path, args: list[str], message: str) -> None:
    done = run_inside(*SMALL, *args, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, b"")
    (line,) = without_progress(done.stderr).decode().splitlines()
    assert message in line
    assert list(tmp_path.iterdir()) == []


def test_a_machine_file_and_an_interpolator_can_be_given(tmp_path: Path) -> None:
    shipped = (resources.files("sim.setup.machine") / "dk7740.toml").read_text("utf-8")
    (tmp_path / "m.toml").write_text(shipped.replace("DK7740 class, stepper drives", "mine"), "utf-8")
    done = run_inside(*SMALL, "--machine", "m.toml", "--interpolator", "card", "--json", cwd=tmp_path)
    result = json.loads(done.stdout)
    assert (result["machine"], result["interpolator"]) == ("mine", "card")


def picture(done: Ballbar) -> Image.Image:
    assert done.measured is not None
    return draw_ballbar(done, done.measured, width_px=900)


def test_golden() -> None:
    assert_golden(picture(with_known_errors()), "ballbar.png")


@pytest.mark.alike(1)
@pytest.mark.parametrize("changed", [{"x_um": 6.5}, {"y_um": 0.0}, {"out_um": 0.0}])
def test_comparison_can_fail(changed: dict[str, float], tmp_path: Path) -> None:
    assert compare(picture(with_known_errors(**changed)), "ballbar.png", tmp_path) != ""


@pytest.mark.parametrize("scale", [1e-3, 1.0, 37.0, 1e4])
def test_rings_have_room_for_any_deviation(scale: float) -> None:
    for most_um in (scale * factor for factor in (1.0, 1.999, 2.0, 4.2, 9.999)):
        ring_um = ring_for(most_um)
        assert ring_um * RINGS >= most_um * (1.0 - 1e-9)
        assert ring_um <= max(1.6 * most_um / RINGS, 0.1)
        assert float(f"{ring_um:.6e}".split("e")[0]) in RING_SIZES


def test_nothing_is_drawn_beyond_the_page() -> None:
    wild = with_known_errors(x_um=900.0, y_um=0.0, out_um=-2000.0)
    border = picture(wild).convert("L").load()
    width, height = picture(wild).size
    rim = [border[x, y] for x in (0, 1, width - 2, width - 1) for y in range(height)]
    assert min(rim) == 255


def test_the_picture_of_a_real_run_has_both_paths() -> None:
    image = picture(run_test(circle_test(load_machine("dk7740"), 1000.0, None), silent))
    colours = {colour for _, colour in image.getcolors(1 << 20)}
    assert {(0, 104, 168), (213, 94, 0), LIGHT[Paint.INK]} <= colours


def test_a_picture_too_narrow_to_read_is_refused() -> None:
    done = with_known_errors()
    with pytest.raises(ValueError, match="600 px"):
        draw_ballbar(done, done.measured, width_px=599)


@pytest.mark.parametrize("language", LANGUAGES)
def test_nothing_of_the_picture_is_cut_off_at_its_edges(language: Language) -> None:
    done = with_known_errors()
    assert done.measured is not None
    picture = np.asarray(draw_ballbar(done, done.measured, language))
    for edge in (picture[:, :2], picture[:, -2:], picture[:2], picture[-2:]):
        assert np.ptp(edge.reshape(-1, 3), axis=0).max() == 0


def test_the_turns_as_written_give_the_circularity_that_is_told(tmp_path: Path) -> None:
    file = tmp_path / "turns.csv"
    done = run_inside(*SMALL, "--json", "--trace", str(file))
    told = json.loads(done.stdout)
    rows = [line.split(",") for line in file.read_text("utf-8").splitlines()]
    assert (done.returncode, rows[0]) == (0, ["turn", "x_um", "y_um"])
    assert [name for name, _ in itertools.groupby(row[0] for row in rows[1:])] == ["ccw", "cw"]
    places = np.array([row[1:] for row in rows[1:]], dtype=np.float64)
    # The least-squares circle, each direction weighing alike: means over cells of 1° of the directions from its centre.
    center = np.zeros(2)
    for _ in range(20):
        off = places - center
        cell = (np.degrees(np.arctan2(off[:, 1], off[:, 0])) % 360.0).astype(int)
        radius = np.bincount(cell, np.hypot(*off.T)) / np.bincount(cell)
        angle = np.radians(np.arange(360) + 0.5)
        center = center + 2.0 * np.array([(radius * np.cos(angle)).mean(), (radius * np.sin(angle)).mean()])
    assert center == pytest.approx(told["figures"]["center_um"], abs=0.1)
    radii = np.hypot(*(places - told["figures"]["center_um"]).T)
    assert np.ptp(radii) == pytest.approx(told["circularity_um"], abs=0.001)
