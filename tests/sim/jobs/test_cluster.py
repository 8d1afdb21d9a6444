"""The same work on the workers of a scheduler: processes of this machine that share nothing, one of them killed."""

import filecmp
import os
import pickle
import subprocess
import sys
import time
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

import pytest
from command import run_inside
from places import ROOT
from shops import TINY, make_shop, rows, run_folder

from parser.findings.errors import ClusterError
from parser.program import read_program
from sim.base.workers.cluster import _caller, cluster
from sim.base.workers.rounds import Processes
from sim.check.file_check import Job, check_any
from sim.check.parallel import check_files
from sim.check.settings import CheckSettings
from sim.jobs.run_into import run_into
from sim.setup.scenario import load_scenario

pytestmark = pytest.mark.skipif(find_spec("distributed") is None, reason="Dask is not installed")
SCHEDULER = ("distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--no-show")
WORKER = ("distributed.cli.dask_worker", "--nthreads", "1", "--no-nanny", "--no-dashboard")


class Running(NamedTuple):
    """A scheduler's address, and the process of each of its workers."""

    address: str
    scheduler: subprocess.Popen[bytes]
    workers: list[subprocess.Popen[bytes]]


@pytest.fixture
def running(tmp_path: Path) -> Iterator[Running]:
    """A scheduler with two workers, each a process with a folder of its own."""
    file = tmp_path / "scheduler.json"
    started = [start(tmp_path / "scheduler", *SCHEDULER, "--scheduler-file", str(file))]
    try:
        started += [start(tmp_path / name, *WORKER, "--scheduler-file", str(file)) for name in ("one", "two")]
        end_s = time.monotonic() + 30.0
        while not file.exists() and time.monotonic() < end_s:
            time.sleep(0.02)
        address = next(part for part in file.read_text("utf-8").split('"') if part.startswith("tcp://"))
        yield Running(address, started[0], started[1:])
    finally:
        for process in started:
            process.kill()
            process.wait()


def start(folder: Path, *arguments: str) -> subprocess.Popen[bytes]:
    folder.mkdir()
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "TMPDIR": str(folder), "PYTHONWARNINGS": "ignore"}
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    return subprocess.Popen([sys.executable, "-m", *arguments], cwd=folder, env=environment, **quiet)


@pytest.mark.deeper
@pytest.mark.filterwarnings("ignore")  # of what Dask itself uses
def test_a_worker_of_two_is_killed_and_then_the_scheduler(running: Running, tmp_path: Path) -> None:
    shop, out = make_shop(tmp_path / "shop", 4), tmp_path / "out"

    def kill_at_first(done: int, total: int) -> None:
        if done == 1:  # the other programs are with the workers
            running.workers[0].kill()

    with cluster(running.address) as pool:
        while pool.ahead() < 4:  # one of the two is not there yet
            time.sleep(0.02)
        checks = [Job(path.name, path, CheckSettings()) for path in (*sorted(shop.iterdir()), tmp_path / "gone.3b")]
        assert list(check_files(checks, pool, lambda done, total: None)) == [check_any(job) for job in checks]
        batch = run_folder(shop, out, pool, progress=kill_at_first)
    told = [(row["verdict"], row["folder"], row["from_cache"]) for row in batch.document["programs"]]
    assert told == [("pass", f"{number:02}.3b", False) for number in range(4)]
    program = shop / "03.3b"
    run_into(tmp_path / "alone", read_program(program), load_scenario(program))
    made = sorted(path.name for path in (tmp_path / "alone").iterdir())
    assert filecmp.cmpfiles(tmp_path / "alone", out / "03.3b", made, shallow=False) == (made, [], [])

    (shop / "04.3b").write_text(TINY.format(50), "ascii")
    start_s = time.monotonic()
    with pytest.raises(ClusterError, match="the scheduler is lost"), cluster(running.address) as pool:
        run_folder(shop, out, pool, progress=lambda done, total: running.scheduler.kill())
    assert time.monotonic() - start_s < 30.0
    run_folder(shop, out, Processes(1))
    assert [row["from_cache"] for row in rows(out).values()] == [True] * 4 + [False]


@pytest.mark.filterwarnings("ignore")
def test_a_scheduler_that_does_not_answer_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sim.base.workers.cluster.MOST_WAIT_S", 0.2)
    make_shop(tmp_path / "shop", 1)
    done = run_inside("run", "shop", "-o", "out", "--scheduler", "tcp://127.0.0.1:9", cwd=tmp_path)
    assert done.returncode == 2
    assert "tcp://127.0.0.1:9: no Dask scheduler answers there" in done.stderr.decode()
    assert not (tmp_path / "out").exists()


def test_a_worker_without_drycut_says_so_and_does_not_die(tmp_path: Path) -> None:
    cloudpickle = pytest.importorskip("cloudpickle")  # by which Dask sends functions
    (tmp_path / "sim").mkdir()
    (tmp_path / "sim" / "__init__.py").touch()
    (tmp_path / "called").write_bytes(cloudpickle.dumps(_caller()))
    (tmp_path / "job").write_bytes(pickle.dumps((run_into, (), {})))
    code = "import cloudpickle, pathlib; path = pathlib.Path; "
    code += "cloudpickle.loads(path('called').read_bytes())(path('job').read_bytes())"
    environment = {**os.environ, "PYTHONPATH": str(tmp_path)}
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, env=environment, capture_output=True, check=False)
    assert b"ImportError: " in done.stderr
    assert b"has another drycut, or none" in done.stderr


def test_where_dask_is_not_installed_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(ClusterError, match=r"pip install 'drycut\[cluster\]'"), cluster("tcp://127.0.0.1:9"):
        pass
