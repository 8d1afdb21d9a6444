"""A shop: what is run, what is taken from the last run, and what becomes of one that fails."""

import filecmp
import json
import os
import signal
from dataclasses import replace
from pathlib import Path

import pytest
from command import run_inside
from jsonschema import Draft202012Validator
from places import ROOT
from shops import TINY, instead_of_running, make_shop, rows, run_folder

import sim.jobs.batch
from parser.findings.errors import ClusterError
from parser.program import read_program
from sim.base.workers.maker import made_by
from sim.base.workers.rounds import Processes
from sim.jobs.run_into import FILES, run_into
from sim.setup.scenario import Scenario, load_scenario
from sim.setup.wire import Wire


@pytest.fixture
def shop(tmp_path: Path) -> Path:
    return make_shop(tmp_path / "shop", 3)


@pytest.fixture
def quick(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing is run."""
    monkeypatch.setattr("sim.jobs.batch._run", instead_of_running)


def complaints(out: Path) -> list[str]:
    schema = json.loads((ROOT / "docs" / "index.schema.json").read_text("utf-8"))
    Draft202012Validator.check_schema(schema)
    index = json.loads((out / "index.json").read_bytes())
    return [f"{error.json_path}: {error.message}" for error in Draft202012Validator(schema).iter_errors(index)]


def cached(out: Path) -> list[bool]:
    return [row["from_cache"] for row in rows(out).values()]


@pytest.mark.deeper
def test_a_program_with_a_drawing_says_how_far_it_is_off(tmp_path: Path) -> None:
    out = tmp_path / "out"
    run_folder(ROOT / "scenarios" / "wrong-side", out)
    (row,) = rows(out).values()
    report = json.loads((out / row["folder"] / "report.json").read_bytes())
    assert row["verdict"] == "fail"
    assert row["drawing_um"] == report["drawing"]["max_um"] > 100.0 * row["max_um"]


def test_files_are_those_of_each_program_alone_and_figures_those_of_its_report(tmp_path: Path) -> None:
    shop, out = make_shop(tmp_path / "shop", 1), tmp_path / "out"
    run_folder(shop, out, Processes(2), language="zh")
    assert complaints(out) == []
    program = shop / "00.3b"
    run_into(tmp_path / "alone", read_program(program), load_scenario(program), language="zh")
    names = sorted(path.name for path in (tmp_path / "alone").iterdir())
    assert set(names) <= set(FILES)
    assert filecmp.cmpfiles(tmp_path / "alone", out / "00.3b", names, shallow=False) == (names, [], [])
    report = json.loads((out / "00.3b" / "report.json").read_bytes())
    row = rows(out)["00.3b"]
    told = (report["verdict"], report["time_s"]["total"], report["deviation"]["wire"]["max_um"])
    assert (row["verdict"], row["time_s"], row["max_um"]) == told
    within = report["time_s"]["interval"]
    assert (row["time_least_s"], row["time_most_s"]) == (within["least"], within["most"])
    first = json.loads((out / "index.json").read_bytes())
    again = run_folder(shop, out, Processes(2), language="zh").document
    assert [row["from_cache"] for row in again["programs"]] == [True]
    assert again["programs"][0] | {"from_cache": False} == first["programs"][0]


@pytest.mark.usefixtures("quick")
def test_a_title_in_chinese_stands_in_the_index_also_when_it_is_from_the_last_run(shop: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    (shop / "scenario.toml").write_text('program = "00.3b"\ntitle = "Die"\ntitle_zh = "凹模"\n', "utf-8")
    for is_cached in (False, True):
        found = {row["file"]: row for row in run_folder(shop, out).document["programs"]}
        die = next(row for row in found.values() if row["title"] == "Die")
        assert (die["title_zh"], die["from_cache"]) == ("凹模", is_cached)
        assert all(row["title_zh"] is None for row in found.values() if row is not die)
    assert complaints(out) == []


@pytest.mark.usefixtures("quick")
def test_what_has_not_changed_is_taken_from_the_last_run(shop: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    run_folder(shop, out)
    page = (out / "index.html").read_bytes()
    assert cached(out) == [False, False, False]
    moved = shop.rename(tmp_path / "moved")
    os.utime(moved / "00.3b", (0, 0))
    run_folder(moved, out)
    assert cached(out) == [True, True, True]
    again = (out / "index.html").read_bytes().replace(b"moved/", b"shop/")
    assert again.replace(b'"from_cache":true', b'"from_cache":false') == page
    run_folder(moved, out, language="zh")
    assert cached(out) == [False, False, False]
    run_folder(moved, out)
    (moved / "01.3b").write_text(TINY.format(99), "ascii")
    (moved / "03.3b").write_text(TINY.format(98), "ascii")
    run_folder(moved, out)
    assert cached(out) == [True, False, True, False]
    assert complaints(out) == []


@pytest.mark.usefixtures("quick")
def test_settings_drawing_and_version_count_and_their_places_do_not(
    shop: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "out"
    (shop / "scenario.toml").write_text(
        'program = "00.3b"\nkerf = true\n[drawing]\nfile = "part.dxf"\nupper = "top.dxf"\n', "utf-8"
    )
    (shop / "part.dxf").write_text("drawing", "ascii")
    (shop / "top.dxf").write_text("of the top", "ascii")
    for change, is_kept in (
        (lambda: None, False),
        (lambda: None, True),
        (lambda: (shop / "part.dxf").write_text("drawn anew", "ascii"), False),
        (lambda: (shop / "top.dxf").write_text("drawn anew", "ascii"), False),
        (lambda: (shop / "scenario.toml").write_text(f"{(shop / 'scenario.toml').read_text()}# aside\n"), True),
        (
            lambda: (shop / "scenario.toml").write_text(f"past_stop = true\n{(shop / 'scenario.toml').read_text()}"),
            False,
        ),
        (lambda: monkeypatch.setattr("sim.jobs.batch.made_by", lambda: (("drycut", "9.9"),)), False),
    ):
        change()
        monkeypatch.setattr("sim.jobs.batch.refuse_other_makers", lambda asked: None)
        run_folder(shop, out)
        assert rows(out)["00.3b"]["from_cache"] == is_kept

    def thicker(path: Path) -> Scenario:
        return replace(load_scenario(path), wire=Wire(diameter_um=200.0, spark_gap_um=10.0))

    run_folder(shop, out, scenario_of=thicker)
    assert not rows(out)["00.3b"]["from_cache"]


@pytest.mark.usefixtures("quick")
@pytest.mark.parametrize("name", ["report.json", "report.html", "kept.json"])
@pytest.mark.parametrize("harm", ["gone", "cut", "changed"])
def test_a_set_that_is_not_whole_is_never_served(shop: Path, tmp_path: Path, name: str, harm: str) -> None:
    out = tmp_path / "out"
    run_folder(shop, out)
    path = out / "01.3b" / name
    data = path.read_bytes()
    path.unlink()
    if harm != "gone":
        path.write_bytes(data[:-1] if harm == "cut" else data.replace(b"1", b"2", 1).replace(b"page", b"pages"))
    run_folder(shop, out)
    assert cached(out) == [True, False, True]
    run_folder(shop, out)
    assert cached(out) == [True, True, True]


@pytest.mark.usefixtures("quick")
def test_one_that_cannot_be_run_or_at_which_drycut_fails_leaves_the_others(shop: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    run_folder(shop, out)
    (shop / "00.3b").write_text("no program", "ascii")
    (shop / "01.3b").write_text(f"// ZERO\n{TINY}".format(5), "ascii")
    (shop / "gone.3b").symlink_to("nowhere")
    for name, scenario in {"odd": "title = 3\n", "drawn": '[drawing]\nfile = "none.dxf"\n'}.items():
        make_shop(shop / name, 1).joinpath("00.3b").rename(shop / name / "program.3b")
        (shop / name / "scenario.toml").write_text(scenario, "utf-8")
    batch = run_folder(shop, out)
    assert complaints(out) == []
    found = {row["file"].removeprefix(f"{shop.as_posix()}/"): row for row in batch.document["programs"]}
    assert {name: row["verdict"] for name, row in found.items()} == {
        "00.3b": "refused",
        "01.3b": "fault",
        "02.3b": "pass",
        "drawn/program.3b": "refused",
        "gone.3b": "refused",
        "odd/scenario.toml": "refused",
    }
    assert found["00.3b"]["findings"] == [{"code": "3B100", "severity": "error", "count": 1}]
    assert found["01.3b"]["message"] == "ZeroDivisionError: boom"
    assert "none.dxf: cannot be read" in found["drawn/program.3b"]["message"]
    assert [name.removeprefix(f"{shop.as_posix()}/") for name in batch.faults] == ["01.3b"]
    assert "Traceback" in next(iter(batch.faults.values()))
    assert not (out / "00.3b").exists()
    assert not (out / "01.3b").exists()
    assert found["02.3b"]["from_cache"]


@pytest.mark.deeper
def test_a_drawing_that_cannot_be_read_is_told_by_its_own_place(
    shop: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (shop / "scenario.toml").write_text('program = "00.3b"\n[drawing]\nfile = "made"\n', "utf-8")
    (shop / "made").write_text("no drawing", "ascii")
    run_folder(shop, tmp_path / "out")
    row = rows(tmp_path / "out")["00.3b"]
    assert row["verdict"] == "refused"
    assert row["message"].startswith(f"{shop / 'made'}: ")


@pytest.mark.usefixtures("quick")
def test_a_run_that_is_stopped_goes_on_where_it_was(
    shop: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "out"
    run_folder(shop, out)
    index = (out / "index.json").read_bytes()
    for name in ("00.3b", "01.3b", "02.3b"):
        (shop / name).write_text(TINY.format(300 + int(name[1])), "ascii")
    keep = sim.jobs.batch.keep

    def stopped(folder: Path, *others: object) -> None:
        if folder.name == "02.3b":
            raise KeyboardInterrupt
        keep(folder, *others)

    monkeypatch.setattr("sim.jobs.batch.keep", stopped)
    with pytest.raises(KeyboardInterrupt):
        run_folder(shop, out)
    assert (out / "index.json").read_bytes() == index
    monkeypatch.setattr("sim.jobs.batch.keep", keep)
    run_folder(shop, out)
    assert cached(out) == [True, True, False]


@pytest.mark.usefixtures("quick")
def test_files_that_a_run_does_not_make_any_more_go_and_others_stay(shop: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    run_folder(shop, out)
    for name in ("trace.npz", "mine.txt"):
        (out / "00.3b" / name).write_text("old", "ascii")
    (out / "00.3b" / "report.json").unlink()
    run_folder(shop, out)
    assert sorted(path.name for path in (out / "00.3b").iterdir()) == [
        "kept.json",
        "mine.txt",
        "report.html",
        "report.json",
    ]


def test_a_worker_of_another_version_is_told(shop: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    other = (*made_by()[:-1], ("system", "Elsewhere"))
    monkeypatch.setattr("sim.jobs.batch.made_by", lambda: other)
    with pytest.raises(ClusterError, match=r"has system .+, not Elsewhere as this machine"):
        run_folder(shop, tmp_path / "out")


def test_the_command_tells_what_came_of_it(
    shop: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, quick: None
) -> None:
    (tmp_path / "kept").mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path / "kept"))
    done = run_inside("run", "shop", "-o", "out", "--jobs", 2, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, b"")
    assert done.stdout.decode().splitlines()[0] == "3 programs: 3 pass"
    (shop / "01.3b").write_text("no program", "ascii")
    done = run_inside("run", "shop", "-o", "out", "--json", cwd=tmp_path)
    assert done.returncode == 1
    assert done.stdout == (tmp_path / "out" / "index.json").read_bytes()
    (shop / "02.3b").write_text(f"// ZERO\n{TINY}".format(5), "ascii")
    done = run_inside("run", "shop/*.3b", "-o", "out", cwd=tmp_path)
    assert done.returncode == 3
    assert "shop/01.3b: refused: no block in the file" in done.stdout.decode()
    assert "drycut: fault: shop/02.3b: ZeroDivisionError: boom" in done.stderr.decode()


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="has no such signal, and starts its processes otherwise")
def test_a_program_that_kills_its_worker_is_told_and_the_others_are_run(
    shop: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def killing(task: sim.jobs.batch.Task, folder: Path) -> sim.jobs.batch.Done:
        if task.name == "01.3b":
            os.kill(os.getpid(), signal.SIGKILL)
        return instead_of_running(task, folder)

    monkeypatch.setattr("sim.jobs.batch._run", killing)
    batch = run_folder(shop, tmp_path / "out", Processes(2))
    assert [row["verdict"] for row in batch.document["programs"]] == ["pass", "fault", "pass"]
    assert "its process ended at once" in batch.document["programs"][1]["message"]


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        (["shop"], "many programs need -o DIR"),
        (["shop/*.nc", "-o", "out"], "no program there"),
        (["shop", "-o", "out", "--card-log", "a.log"], "--card-log takes the calls of one program"),
        (["shop", "-o", "out", "--trace"], "--trace is for one program"),
        (["shop/00.3b", "-o", "out", "--jobs", "2"], "this is one"),
        (["shop", "-o", "out", "--jobs", "0"], "--jobs"),
        (["shop", "-o", "out", "--jobs", "2", "--scheduler", "tcp://127.0.0.1:1"], "say two things"),
        (["shop", "-o", "out", "--scheduler", "host"], "is no address of a scheduler, such as tcp://host:8786"),
        (["shop", "-o", "out", "--machine", "none"], "machine 'none' is not shipped"),
        (["shop", "-o", "shop/00.3b"], "is a file"),
    ],
)
def test_bad_use_is_told(shop: Path, arguments: list[str], why: str, quick: None) -> None:
    done = run_inside("run", *arguments, cwd=shop.parent)
    assert done.returncode == 2
    assert why in " ".join(done.stderr.decode().split())
