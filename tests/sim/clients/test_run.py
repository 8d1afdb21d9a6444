"""Programs in C as dry runs: what their calls did to the table, in the files of a run."""

import json
import re
import shutil
import signal
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from c_library import Made
from command import run_command, run_inside
from report_schema import complaints

HOMES = "[[switches]]\nnegative = -90000\npositive = 90000\nhome = [-60000, -40000]\nindex_every = 2000\n"


def card_run(
    library: Made, folder: Path, client: Path, *options: str, card: str = "", hears_client: bool = False
) -> tuple[Any, dict[str, Any]]:
    """The ended command and the report that it wrote; what the client prints is heard in a process of its own alone."""
    if card:
        (folder / "card.toml").write_text(card, "utf-8")
        options = ("--card", "card.toml", *options)
    run = run_command if hears_client else run_inside
    done = run("card", "run", "--library", str(library.folder), "-o", "out", *options, "--", str(client), cwd=folder)
    report = folder / "out" / "report.json"
    return done, json.loads(report.read_text("utf-8")) if report.exists() else {}


@pytest.mark.deeper
def test_a_client_that_looks_at_nothing_is_told_what_it_did_not_see(library: Made, tmp_path: Path) -> None:
    done, report = card_run(library, tmp_path, library.client("measure"), card=HOMES, hears_client=True)
    assert (done.returncode, complaints(report)) == (0, [])
    card = report["card"]
    assert card["places"] == [[-40_000, 0, 0, 0]]
    assert [(one["call"], one["code"]) for one in card["refused_unread"]] == [
        ("GT_ZeroPos(1)", 1),
        ("GT_ZeroPos(2)", 1),
        ("GT_LnXY(30000.0, 20000.0)", 1),
    ]
    (limit,) = card["ended_on_limit"]
    assert (limit["axis"], limit["limit"], limit["then"]) == (1, "positive", "GT_LnXY(0.0, 0.0)")
    (sleep,) = card["sleeps_too_short"]
    # 30,000 pulses at 0.01 pulse/ms²: √30,000 / 0.1 ms up to the middle, as long again; the call took 1 ms.
    assert sleep["needed_s"] == pytest.approx(2e-3 * np.sqrt(30_000 / 0.01), abs=2e-3)
    assert [finding["code"] for finding in report["findings"]] == ["GEC403", "GEC402"]
    assert b"GEC403" in done.stdout
    assert b"done: 0 0 0 2001" in done.stdout


def test_a_sound_client_is_silent_and_its_path_is_what_it_drove(library: Made, tmp_path: Path) -> None:
    done, report = card_run(library, tmp_path, library.client("stream"))
    assert (done.returncode, complaints(report), report["findings"]) == (0, [], [])
    # Six layers: 9,000 + a quarter of R 1,000 + 8,000 + a quarter + 8,000 + √2·1,000 + 9,000, and the way back to 0.
    layer = 9_000 + 8_000 + 8_000 + 9_000 + 1_000 * (np.pi + np.sqrt(2.0))
    assert report["summary"]["length_um"] == pytest.approx(6 * layer, abs=0.1)
    assert report["summary"]["steps"] == pytest.approx(6 * 40_000, abs=0)
    assert report["card"]["places"] == [[0, 0, 60_000, 0]]
    assert report["deviation"]["table"]["max_um"] < 2.0, "a table that follows"
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert names == {"report.html", "replay.html", "cut.png", "report.json", "card.log", "calls.txt"}
    calls = (tmp_path / "out" / "calls.txt").read_text("utf-8").splitlines()
    assert [calls[block["line"] - 1].split("GT_")[1] for block in report["blocks"][:2]] == [
        "LnXYZ(9000.0, 0.0, 0.0) = 0",
        "ArcXY(9000.0, 1000.0, 90.0) = 0",
    ]


@pytest.mark.deeper
def test_a_machine_that_is_named_has_its_own_table(library: Made, tmp_path: Path) -> None:
    limits = "[[switches]]\nnegative = -40000\n[[switches]]\nnegative = -60000\n"
    done, report = card_run(library, tmp_path, library.client("scan"), "--machine", "dk7740", card=limits)
    assert done.returncode == 1
    assert "3B402" in [finding["code"] for finding in report["findings"]], "50 mm/s at 500 mm/s² is too much for it"
    assert complaints(report) == []


@pytest.mark.deeper
def test_a_killed_client_is_run_as_far_as_it_came(library: Made, tmp_path: Path) -> None:
    done, report = card_run(library, tmp_path, library.client("killed"))
    assert (done.returncode, complaints(report)) == (1, [])
    assert report["card"]["ended"] == {"code": None, "signal": signal.SIGKILL.name, "is_stopped": False}
    assert report["card"]["calls"] == 503
    assert report["card"]["places"] == [[100_000, 0, 0, 0]]
    assert report["card"]["went_on_s"] == pytest.approx(99.6, abs=0.1)
    assert b"killed was killed by SIGKILL" in done.stdout


def made(library: Made, folder: Path, text: str) -> Path:
    (folder / "own.c").write_text(f'#include "client.h"\nint main(void) {{ {text} }}\n', "utf-8")
    done = library.compile(folder / "own.c", folder / "own")
    assert (done.returncode, done.stderr) == (0, "")
    return folder / "own"


@pytest.mark.deeper
def test_a_client_that_hangs_is_stopped_with_what_it_started(library: Made, tmp_path: Path) -> None:
    client = made(library, tmp_path, 'GT_Open(65535); GT_LnXY(500, 0); system("sleep 300 &"); for (;;) sts(1);')
    done, report = card_run(library, tmp_path, client, "--timeout", "1.5")
    assert done.returncode == 1
    assert report["card"]["ended"] == {"code": None, "signal": None, "is_stopped": True}
    assert report["card"]["places"] == [[500, 0, 0, 0]]
    assert b"All that it did last was to ask: GT_GetSts(1)" in done.stdout


def test_without_motion_there_is_no_page_and_the_calls_are_told(library: Made, tmp_path: Path) -> None:
    client = made(library, tmp_path, "GT_Open(65535); GT_LnXYZ(0, 0, 100); GT_AxisOn(7); GT_SetSynVel(2); return 0;")
    done, report = card_run(library, tmp_path, client)
    assert (done.returncode, report["schema"]) == (0, "drycut.card/1")
    assert report["card"]["refused_unread"][0]["call"] == "GT_AxisOn(7)"
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"report.json", "card.log", "calls.txt"}
    assert re.search(rb"neither X nor Y moved", done.stdout)


@pytest.mark.deeper
def test_json_is_the_report_and_what_the_client_prints_goes_aside(library: Made, tmp_path: Path) -> None:
    done, report = card_run(library, tmp_path, library.client("measure"), "--json", card=HOMES, hears_client=True)
    assert json.loads(done.stdout) == report
    assert b"done: 0 0 0 2001" in done.stderr


@pytest.mark.parametrize(
    ("text", "options", "said"),
    [
        ("return 0;", (), b"made no call to the card"),
        ("return 0;", ("--card", "none.toml"), b"none.toml: cannot be read"),
        ("return 0;", ("--library", "."), b"libges.so: no such file; 'drycut card build' makes it"),
        ("return 0;", ("--machine", "none"), b"'none' is not shipped"),
    ],
)
def test_what_cannot_be_run_is_said_and_nothing_is_written(
    library: Made, tmp_path: Path, text: str, options: tuple[str, ...], said: bytes
) -> None:
    done, report = card_run(library, tmp_path, made(library, tmp_path, text), *options)
    assert (done.returncode, report) == (2, {})
    assert said in done.stderr
    assert not (tmp_path / "out").exists()


def test_a_client_that_is_not_there_is_said(library: Made, tmp_path: Path) -> None:
    done, _ = card_run(library, tmp_path, tmp_path / "nowhere")
    assert done.returncode == 2
    assert b"nowhere: cannot be started: No such file or directory" in done.stderr


def test_a_library_that_the_loader_would_not_find_is_refused(library: Made, tmp_path: Path) -> None:
    odd = tmp_path / "my lib"
    shutil.copytree(library.folder, odd, ignore=shutil.ignore_patterns("clients"))
    done = run_inside("card", "run", "--library", str(odd), "-o", "out", "--", "/bin/true", cwd=tmp_path)
    assert done.returncode == 2
    assert b"not found in a folder with a blank or colon" in b" ".join(done.stderr.split())
    assert not (tmp_path / "out").exists()
