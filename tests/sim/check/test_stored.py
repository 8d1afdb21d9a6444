"""Results that stay in a folder: what comes from there is what a check would give, and whatever changed is checked."""

import json
import os
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import pytest
from checking import SOUND, WRONG_AXIS, drycut
from places import SCENARIOS

from parser.dialect.reader import OwnDialect
from parser.findings.errors import FileUnreadableError
from sim.check import stored
from sim.check.file_check import Job, check_any, check_file
from sim.check.files import STORED
from sim.check.result import CheckResult
from sim.check.settings import CheckSettings
from sim.check.stored import with_stored
from sim.setup.machine.machine import load_machine

MACHINE = load_machine("dk7740")
SILENT = "B9900B0B9900GXL1\nB9900B0B9900GXL3\nDD\n"
ISO = "G92 X0 Y0\nG01 X10. Y0\nG01 X10. Y10.\nG01 X0 Y0\nM02\n"


class Checker:
    """Checks jobs, and tells which."""

    def __init__(self) -> None:
        self.names: list[str] = []

    def __call__(self, jobs: Sequence[Job]) -> Iterator[CheckResult]:
        for job in jobs:
            self.names.append(job.name)
            yield check_any(job)


def nothing_refused(error: FileUnreadableError) -> None:
    raise error


def checked(folder: Path, *jobs: Job) -> tuple[list[CheckResult], list[str]]:
    """Results of jobs, and the names of those that were checked."""
    checker = Checker()
    return list(with_stored(jobs, folder, checker, nothing_refused)), checker.names


def job(text: str, name: str = "part.3b", known: frozenset[str] = frozenset(), **settings: object) -> Job:
    return Job(name, text.encode(), replace(CheckSettings(), **settings), known)  # type: ignore[arg-type]


def test_what_comes_from_the_folder_is_what_a_check_gives(tmp_path: Path) -> None:
    texts = {path.parent.name: path.read_text("utf-8") for path in sorted(SCENARIOS.glob("*/program.*"))}
    jobs = [job(text, name) for name, text in {**texts, "part.iso": ISO, "part.4b": SOUND}.items()]
    jobs.append(job(WRONG_AXIS, "silenced.3b", ignore=("3B",), fail_on="warning", file="drycut.toml"))
    silent = [each.name for each in jobs if not (found := check_file(each)).findings and not found.unreadable]
    assert len(silent) > 8
    first, names = checked(tmp_path, *jobs)
    assert names == [each.name for each in jobs]
    again, names = checked(tmp_path, *jobs)
    assert names == [each.name for each in jobs if each.name not in silent]
    assert again == first == [check_file(each) for each in jobs]


@pytest.mark.parametrize(
    "other",
    [
        job(SILENT + "\n"),
        job(SILENT, "other.3b"),
        job(SILENT, known=frozenset({"0" * 32})),
        job(SILENT, select=("3B1",)),
        job(SILENT, ignore=("3B1",)),
        job(SILENT, ignore_here=("3B1",)),
        job(SILENT, fail_on="warning"),
        job(SILENT, may_stay_open=True),
        job(SILENT, wire_diameter_um=180.0),
        job(SILENT, spark_gap_um=10.0),
        job(SILENT, file="drycut.toml"),
        job(SILENT, by_options=frozenset({"fail_on"})),
        job(SILENT, registers=(("D0", 100.0),)),
        job(SILENT, dialect=OwnDialect("makino", "fanuc", "{}")),
        job(SILENT, dialect=OwnDialect("makino", "fanuc", '{"unit": "um"}')),
        job(SILENT, machine=MACHINE),
        job(SILENT, machine=MACHINE._replace(table=MACHINE.table._replace(travel_x_mm=399.0))),
    ],
    ids=range(17),
)
def test_whatever_a_result_follows_from_is_checked_again_once_it_changed(tmp_path: Path, other: Job) -> None:
    first = job(SILENT)
    if isinstance(other.settings.dialect, OwnDialect) and "unit" in other.settings.dialect.changed:
        first = job(SILENT, dialect=OwnDialect("makino", "fanuc", "{}"))
    if other.settings.machine and other.settings.machine is not MACHINE:
        first = job(SILENT, machine=MACHINE)
    assert checked(tmp_path, first)[1] == [first.name]
    assert checked(tmp_path, first)[1] == []
    assert checked(tmp_path, other)[1] == [other.name]
    assert checked(tmp_path, first)[1] == []


def test_names_of_options_are_a_set_in_any_order(tmp_path: Path) -> None:
    names = ("select", "ignore", "fail_on", "machine", "dialect")
    assert checked(tmp_path, job(SILENT, by_options=frozenset(names)))[1] != []
    assert checked(tmp_path, job(SILENT, by_options=frozenset(reversed(names))))[1] == []


def test_a_file_with_findings_is_checked_every_time(tmp_path: Path) -> None:
    wrong = job(WRONG_AXIS)
    for _ in range(3):
        results, names = checked(tmp_path, wrong)
        assert names == ["part.3b"]
        assert results[0].findings


def test_damage_of_any_kind_means_a_check(tmp_path: Path) -> None:
    silent = job(SILENT)
    checked(tmp_path, silent)
    whole = (tmp_path / STORED).read_bytes()
    seal, body = whole.split(b"\n")
    half = len(whole) // 2
    assert json.loads(body)
    flipped = whole[:half] + b"\xff" + whole[half + 1 :]
    for damaged in (b"", b"\n", whole[:half], whole + b" ", seal, flipped, b"[" * 9_999):
        (tmp_path / STORED).write_bytes(damaged)
        results, names = checked(tmp_path, silent)
        assert names == ["part.3b"]
        assert results == [check_file(silent)]
        assert checked(tmp_path, silent)[1] == []


@pytest.mark.parametrize(
    "change",
    [
        {"checks": []},
        {"checks": [["check-grammar", "fine", "", []]]},
        {"checks": [["check-grammar"]]},
        {"blocks": [1, 2]},
        {"steps": "many"},
        {"silenced": [1]},
        {"programmed": [1]},
        {"assumptions": 3},
        {"length_um": None},
        {"length_um": 10**400},
    ],
)
def test_a_record_of_another_shape_is_none_even_under_its_seal(tmp_path: Path, change: dict[str, object]) -> None:
    silent = job(SILENT)
    checked(tmp_path, silent)
    ((key, record),) = json.loads((tmp_path / STORED).read_bytes().split(b"\n")[1]).items()
    if change == {"checks": []}:
        record = []
    body = json.dumps({key: record if record == [] else record | change}).encode()
    (tmp_path / STORED).write_bytes(stored.seal(body).encode() + b"\n" + body)
    results, names = checked(tmp_path, silent)
    assert (results, names) == ([check_file(silent)], ["part.3b"])


def test_another_drycut_checks_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    checked(tmp_path, job(SILENT))
    monkeypatch.setattr(stored, "made_by", lambda: (("drycut", "9.9"),))
    assert checked(tmp_path, job(SILENT))[1] == ["part.3b"]


def test_programs_beyond_its_room_are_checked_from_their_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stored, "_ROOM", len(SILENT))
    jobs = [job(SILENT, "a.3b"), job(SILENT, "b.3b")]
    assert checked(tmp_path, *jobs)[1] == ["a.3b", "b.3b"]
    assert checked(tmp_path, *jobs)[1] == ["b.3b"]
    assert checked(tmp_path, *jobs)[1] == []


def test_the_oldest_results_go_where_they_are_many(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stored, "_MOST", 2)
    for name in ("a.3b", "b.3b", "a.3b", "c.3b"):
        checked(tmp_path, job(SILENT, name))
    assert checked(tmp_path, job(SILENT, "a.3b"))[1] == []
    assert checked(tmp_path, job(SILENT, "b.3b"))[1] == ["b.3b"]


class TestCommand:
    @pytest.fixture
    def shop(self, tmp_path: Path) -> Path:
        (tmp_path / "good.3b").write_text(SILENT, "ascii")
        (tmp_path / "bad.3b").write_text(WRONG_AXIS, "ascii")
        return tmp_path

    @pytest.mark.parametrize("form", ["text", "json", "sarif"])
    def test_it_says_the_same_with_results_and_without(self, shop: Path, form: str) -> None:
        plain = drycut("check", ".", "--format", form, cwd=shop)
        for _ in range(2):
            assert drycut("check", ".", "--format", form, "--cache", "results", cwd=shop) == plain
        assert plain[0] == 1
        assert (shop / "results" / ".gitignore").read_text("ascii") == "*\n"

    def test_what_a_baseline_knows_is_counted_as_before(self, shop: Path) -> None:
        drycut("check", ".", "--write-baseline", "known.json", "--cache", "results", cwd=shop)
        plain = drycut("check", ".", "--baseline", "known.json", cwd=shop)
        for _ in range(2):
            assert drycut("check", ".", "--baseline", "known.json", "--cache", "results", cwd=shop) == plain
        (shop / "bad.3b").write_text(SOUND, "ascii")
        mended = drycut("check", ".", "--baseline", "known.json", cwd=shop)
        assert "no longer occur: 1" in mended[2]
        for _ in range(2):
            assert drycut("check", ".", "--baseline", "known.json", "--cache", "results", cwd=shop) == mended

    def test_a_fault_that_is_new_is_found(self, shop: Path) -> None:
        drycut("check", "good.3b", "--cache", "results", cwd=shop)
        state = (shop / "good.3b").stat()
        (shop / "good.3b").write_text(SILENT.replace("GX", "GY", 1), "ascii")  # of the same length, at the same time
        os.utime(shop / "good.3b", ns=(state.st_atime_ns, state.st_mtime_ns))
        assert drycut("check", "good.3b", "--cache", "results", cwd=shop)[0] == 1

    def test_a_folder_of_the_users_stays_as_it_is(self, shop: Path) -> None:
        drycut("check", ".", "--cache", ".", cwd=shop)
        assert sorted(path.name for path in shop.iterdir()) == ["bad.3b", STORED, "good.3b"]
        assert "passed over" not in drycut("check", ".", "--cache", ".", cwd=shop)[2]

    def test_a_folder_that_cannot_be_is_said_and_changes_no_verdict(self, shop: Path) -> None:
        (shop / "file").write_text("x", "ascii")
        code, out, err = drycut("check", "good.3b", "--cache", "file/results", cwd=shop)
        assert (code, out) == drycut("check", "good.3b", cwd=shop)[:2]
        assert err.startswith("drycut: --cache: results are not stored: ")
        assert drycut("check", "good.3b", "--cache", "file", cwd=shop)[0] == 2
