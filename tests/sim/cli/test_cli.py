"""The command line as a user meets it, with good and with bad input; in a process of its own where that matters."""

import ast
import json
import os
import subprocess
import sys
from collections.abc import Callable
from importlib import resources
from pathlib import Path

import pytest
from click import Context
from click.testing import CliRunner
from command import run_command, run_inside, without_progress
from places import ROOT, SCENARIOS
from trees import trees

from drycut import __version__
from sim.base.workers.maker import sources
from sim.cli import cli

SOUND = "B9900B0B9900GXL1 B9900B0B39600GYNR1 B9900B0B9900GXL3 DD"


def drycut(*args: str | Path, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    done = run_inside(*args, cwd=cwd)
    return subprocess.CompletedProcess(done.args, done.returncode, done.stdout.decode(), done.stderr.decode())


@pytest.fixture
def part(tmp_path: Path) -> Path:
    path = tmp_path / "零件.3b"
    path.write_text(SOUND, "utf-8")
    return path


@pytest.fixture
def short(tmp_path: Path) -> Path:
    """A program that has run before progress would be told."""
    path = tmp_path / "零件.3b"
    path.write_text("B500B0B500GXL1 B0B500B500GYL2 B500B0B500GXL3 B0B500B500GYL4 DD", "utf-8")
    return path


def test_a_sound_program_passes_and_prints_its_figures(part: Path) -> None:
    process = run_command("run", part)
    assert (process.returncode, without_progress(process.stderr)) == (0, b"")
    done = drycut("run", part)
    assert (done.returncode, done.stdout) == (0, process.stdout.decode())
    for figure in (
        "零件.3b",
        "82.004 mm",
        "0.2 mm",
        "99,000",
        "31 min",
        "0.00 µm exact, 0.00 µm stepped",
        "verdict: pass",
    ):
        assert figure in done.stdout


def test_output_goes_where_it_is_sent(short: Path, tmp_path: Path) -> None:
    done = drycut("run", short, "-o", tmp_path / "a" / "b")
    assert done.returncode == 0
    written = ["report.html", "replay.html", "cut.png", "report.json"]
    assert sorted(path.name for path in (tmp_path / "a" / "b").iterdir()) == sorted(written)
    assert done.stdout.splitlines()[-1] == f"written: {tmp_path / 'a' / 'b'}/ {', '.join(written)}"
    again = drycut("run", short, "-o", tmp_path / "a" / "b", "--trace")
    written.append("trace.npz")
    assert sorted(path.name for path in (tmp_path / "a" / "b").iterdir()) == sorted(written)
    assert again.stdout.splitlines()[-1] == f"written: {tmp_path / 'a' / 'b'}/ {', '.join(written)}"


def test_a_trace_needs_a_folder_and_one_program(short: Path, tmp_path: Path) -> None:
    for arguments, message in (((short,), "--trace needs -o DIR"), ((short, short, "-o", "out"), "for one program")):
        done = drycut("run", *arguments, "--trace", cwd=tmp_path)
        assert (done.returncode, done.stdout) == (2, "")
        assert message in done.stderr
        assert not (tmp_path / "out").exists()


def test_without_output_no_file_is_written(short: Path, tmp_path: Path) -> None:
    drycut("run", short.name, cwd=tmp_path)
    assert list(tmp_path.iterdir()) == [short]


def test_a_scenario_folder_runs(tmp_path: Path) -> None:
    done = drycut("run", SCENARIOS / "punch")
    assert done.returncode == 0
    for figure in ("Punch: a plate of 12 × 8 mm with a slot", "0.1 mm to the right", "off drawing.dxf"):
        assert figure in done.stdout
    assert drycut("run", ".", cwd=SCENARIOS / "punch").stdout == done.stdout


def test_json_is_the_report(short: Path, tmp_path: Path) -> None:
    done = drycut("run", short, "--json", "-o", tmp_path / "out")
    assert done.stdout == (tmp_path / "out" / "report.json").read_text("utf-8")
    assert json.loads(done.stdout)["schema"] == "drycut.report/1"


def test_options_take_the_place_of_the_scenario(short: Path, tmp_path: Path) -> None:
    shipped = (resources.files("sim.setup.machine") / "dk7740.toml").read_text("utf-8")
    machine = tmp_path / "mine.toml"
    machine.write_text(shipped.replace("DK7740 class, stepper drives", "mine"), "utf-8")
    done = drycut(
        *("run", short, "--json", "--machine", machine, "--thickness", "60mm"),
        *("--wire-diameter", "0.12mm", "--gap", "15um", "--wire-lag", "20um"),
    )
    report = json.loads(done.stdout)
    assert report["machine"]["name"] == "mine"
    assert report["work"]["thickness_mm"] == 60.0
    assert report["wire"] == {"diameter_um": 120.0, "spark_gap_um": 15.0, "kerf_um": 150.0, "lag_um": 20.0}


def test_a_failed_verdict_exits_1_and_names_line_and_code(tmp_path: Path) -> None:
    path = tmp_path / "part.3b"
    path.write_text(SOUND.replace("GYNR1", "GYNR5").replace(" ", "\n"), "utf-8")
    done = drycut("run", path)
    assert done.returncode == 1
    assert "part.3b:2:16: error[3B106]: " in done.stdout
    assert "\n  2 | B9900B0B39600GYNR5\n    |                ^^^\n" in done.stdout
    assert "verdict: fail" in done.stdout


def _huge(path: Path) -> None:
    path.write_text("B1B0B1GXL1\nN2: B0B0B1000000000000000GXL1", "utf-8")


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda path: path.write_bytes(b""), "part.3b: error[3B100]: no 3B program\n    = found:    the file is empty"),
        (
            lambda path: path.write_bytes(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0"),
            "part.3b: error[3B100]: no 3B program\n    = found:    this is a picture",
        ),
        (
            lambda path: path.write_text("hello", "utf-8"),
            "part.3b: error[3B100]: no 3B program\n    = found:    no block",
        ),
        (lambda path: path.mkdir(), "part.3b: no program there; expected files that end in .3b"),
        (lambda path: None, "cannot be read: No such file"),
        (_huge, "part.3b:2:5: error[3B206]: number beyond any table\n  2 | N2: B0B0B1000000000000000GXL1\n"),
    ],
    ids=["empty", "picture", "no block", "folder", "missing", "huge count"],
)
def test_bad_programs_exit_2_with_one_clear_error(tmp_path: Path, make: object, message: str) -> None:
    path = tmp_path / "part.3b"
    make(path)
    done = drycut("run", path, "-o", tmp_path / "out")
    assert done.returncode == 2
    assert done.stdout == ""
    assert message in done.stderr
    assert done.stderr.startswith(("drycut: error: ", f"{path}:"))
    assert "Traceback" not in done.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("args", "message"),
    [
        (["--machine", "dk9"], "machine 'dk9' is not shipped; known: dk7732, dk7740"),
        (["--thickness", "40"], "'40' is no length"),
        (["--thickness", "0mm"], "--thickness in mm is 0; it must lie between"),
        (["--wire-diameter", "0.02mm", "--gap=-40um"], "cuts no kerf"),
        (["--wire-lag", "2mm"], "--wire-lag in µm is 2000; it must lie between 0 and 1000"),
        (["--wire-lag", "20"], "'20' is no length"),
        (["--nonsense"], "No such option"),
        (["-o", __file__], "is a file; a folder of this name is to be written into"),
    ],
)
def test_bad_options_exit_2_with_one_clear_line(short: Path, args: list[str], message: str) -> None:
    done = drycut("run", short, *args)
    assert (done.returncode, done.stdout) == (2, "")
    assert message in done.stderr
    assert len(done.stderr.splitlines()) == 1


def test_bad_machine_files_are_named(short: Path, tmp_path: Path) -> None:
    shipped = (resources.files("sim.setup.machine") / "dk7740.toml").read_text("utf-8")
    for text, message in (
        (
            shipped.replace("saddle_mass_kg", "sadle_mass_kg"),
            "unknown key 'sadle_mass_kg'; did you mean saddle_mass_kg?",
        ),
        (shipped.replace("= 140.0", "= -140.0"), "carriage_mass_kg is -140"),
    ):
        (tmp_path / "m.toml").write_text(text, "utf-8")
        done = drycut("run", short, "--machine", tmp_path / "m.toml", "-o", tmp_path / "out")
        assert done.returncode == 2
        assert message in done.stderr
        assert not (tmp_path / "out").exists()


@pytest.mark.alike(2)
@pytest.mark.parametrize(
    ("encoding", "run"), [("ascii", run_command), ("gbk", run_inside), ("ascii", run_inside), ("cp1252", run_inside)]
)
def test_any_encoding_of_the_output_will_do(
    short: Path, encoding: str, run: Callable[..., subprocess.CompletedProcess[bytes]]
) -> None:
    of_its_own = {"PYTHONIOENCODING": encoding, "PYTHONUTF8": "0"} if run is run_command else {"encoding": encoding}
    done = run("run", short, **of_its_own)
    assert (done.returncode, without_progress(done.stderr)) == (0, b"")
    assert "0.00 um exact" in done.stdout.decode(encoding).replace("µ", "u")


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="has no device that is always full")
def test_output_that_cannot_be_written_is_one_clear_line(short: Path) -> None:
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "drycut", "run", str(short)],
            stdout=full,
            stderr=subprocess.PIPE,
            check=False,
            env={**os.environ, "PYTHONPATH": str(ROOT)},
        )
    told = without_progress(done.stderr)
    assert (done.returncode, told) == (2, b"drycut: error: output: No space left on device\n")


def test_names_are_shown_as_they_can_be(tmp_path: Path) -> None:
    for name in ("[red]a.3b", "error[1].3b", "a" * 300 + ".3b"):
        done = drycut("run", tmp_path / name)
        assert (done.returncode, len(done.stderr.splitlines())) == (2, 1)
        assert done.stderr.startswith("drycut: error: ")
    path = tmp_path / "[red]\x1b[31m.3b"
    path.write_text("B500B0B500GXL1 DD", "utf-8")
    assert "[red]\ufffd[31m.3b" in drycut("run", path).stdout


def test_long_work_shows_its_progress_on_stderr(short: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sim.cli.progress._QUIET_S", 0.0)  # as if any work were long
    done = drycut("run", short)
    assert "drycut: " in done.stderr
    assert "%" in done.stderr
    assert "drycut: " not in done.stdout


def test_version_and_help() -> None:
    assert drycut("--version").stdout == f"drycut, version {__version__}, sources {sources()}\n"
    assert "run      Dry-run a 3B or ISO program" in drycut("--help").stdout
    assert "drycut run part.3b -o out/\n" in drycut("run", "--help").stdout
    assert drycut().returncode == 2
    assert drycut("frobnicate").returncode == 2


@pytest.mark.parametrize("command", sorted(cli.list_commands(Context(cli))))
def test_help_fits_a_terminal(command: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    shown = CliRunner().invoke(cli, [command, "--help"]).output.splitlines()
    assert [line for line in shown if len(line) > 80] == []


def test_version_imports_nothing_heavy() -> None:
    code = (
        "import sys; from sim.cli import cli; cli.main(['--version'], standalone_mode=False);"
        "print(*sorted({'numpy', 'pymunk', 'pygame', 'PIL', 'rich'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=ROOT)
    assert done.stdout.splitlines()[1:] == [""]


def test_run_prints_the_hints_that_check_prints(short: Path) -> None:
    short.write_text(short.read_text("utf-8").replace("GYL4", "GYL3"), "utf-8")
    told = [drycut(command, short).stdout.splitlines() for command in ("run", "check")]
    hints = [{line.strip() for line in lines if " = hint: " in line} for lines in told]
    assert hints[0] == hints[1] == {"= hint:     write L4"}


def test_run_without_output_needs_no_pictures(short: Path) -> None:
    code = (
        f"import sys; from sim.cli import cli; cli.main(['run', {str(short)!r}], standalone_mode=False);"
        "print('drawn' if {'pygame', 'PIL'} & set(sys.modules) else 'not drawn')"
    )
    done = subprocess.run(
        [sys.executable, "-X", "utf8", "-c", code],
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=True,
        cwd=ROOT,
    )
    assert done.stdout.splitlines()[-1] == "not drawn"


def test_the_card_log_of_a_run_replays_and_takes_no_other_files_place(tmp_path: Path) -> None:
    part, log = tmp_path / "part.3b", tmp_path / "logs" / "part.log"
    part.write_text("B500B0B500GXL1 B500B0B2000GYNR1 B500B0B500GXL3 DD")
    assert run_inside("run", part, "--interpolator", "card", "--card-log", log).returncode == 0
    replayed = run_inside("card", "replay", log)
    assert (replayed.returncode, replayed.stderr) == (0, b"")
    assert b": equal: " in replayed.stdout
    for other, output in ((part, None), (tmp_path / "out" / "cut.png", tmp_path / "out"), (Path("/dev/full"), None)):
        before = part.read_bytes()
        done = run_inside("run", part, "--card-log", other, *(["-o", output] if output else []))
        assert done.returncode == 2
        assert done.stderr.startswith(b"drycut: error: ")
        assert part.read_bytes() == before
        assert not (tmp_path / "out").exists()


def test_a_refused_run_leaves_no_card_log(tmp_path: Path) -> None:
    part = tmp_path / "part.3b"
    part.write_text("B0B0B1000000000000GXL1")
    assert run_inside("run", part, "--card-log", tmp_path / "new" / "part.log").returncode == 2
    assert sorted(path.name for path in tmp_path.iterdir()) == ["part.3b"]


def test_a_scenario_run_by_another_interpolator_is_held_to_all_but_its_steps(tmp_path: Path) -> None:
    expected = '"summary.steps" = 7\n"contours.0.closure_stepped_um" = 7.0\n"summary.blocks" = 3\n'
    (tmp_path / "program.3b").write_text("B500B0B500GXL1 B500B0B2000GYNR1 B500B0B500GXL3 DD")
    (tmp_path / "scenario.toml").write_text(f"[expect]\n{expected}", "utf-8")
    done = run_inside("run", tmp_path, "--interpolator", "card")
    assert done.returncode == 0
    assert b"another interpolator steps: summary.steps, contours.0.closure_stepped_um" in done.stderr
    (tmp_path / "scenario.toml").write_text('[expect]\n"summary.blocks" = 4\n', "utf-8")
    assert run_inside("run", tmp_path, "--interpolator", "card").returncode == 1
    (tmp_path / "scenario.toml").write_text(f"[expect]\n{expected}", "utf-8")
    own = run_inside("run", tmp_path, "--interpolator", "point-by-point")
    assert (own.returncode, b"[expect]" in own.stderr) == (1, False)


@pytest.mark.parametrize("command", [["check"], ["draw", "-o", "path.svg"], ["time"]])
def test_a_program_of_3b_loads_no_other_language_and_no_writer(tmp_path: Path, command: list[str]) -> None:
    (tmp_path / "part.3b").write_text("B0B5000B5000GYL2\nB0B5000B5000GYL4\nDD\n", "ascii")
    script = (
        "import sys; from sim.cli import cli\n"
        "others = ('parser.iso.reading', 'parser.iso.listing', 'parser.pmac.reading', 'parser.write')\n"
        "try: cli.main(sys.argv[1:], standalone_mode=False)\n"
        "finally: print([name for name in others if name in sys.modules])"
    )
    named = [command[0], "part.3b", *command[1:]]
    line = [sys.executable, "-c", script, *named]
    done = subprocess.run(line, cwd=tmp_path, capture_output=True, text=True, check=True, timeout=60)
    assert done.stdout.splitlines()[-1] == "[]"


def test_no_module_imports_from_itself() -> None:
    """What is imported late to start sooner stands in another module: two that were made one start as late as ever."""
    found = [
        f"{path}:{node.lineno}"
        for path, tree in trees().items()
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.module == ".".join(path.with_suffix("").parts)
    ]
    assert found == []
