"""The promises of `fuzz.py`, tried on inputs that reach new code: ``make guided``, or by the line below.

``PYTHONPATH=. python tests/tools/guided_fuzz.py --seconds 600 --target iso``

atheris (libFuzzer) stores each input that reaches code which none before it reached, and changes those on. It knows
bytes alone, our own damage knows programs: a part of the inputs is changed by that, or made anew. What is stored stays
in ``out/fuzz/TARGET``, and the next time begins there. An input that breaks a promise stands in ``out/fuzz/broken``;
``--target TARGET --file out/fuzz/broken/…`` tries it again.

`make fuzz` counts its inputs and makes each of them again by its number; here the number of an input is its check sum.
"""

import argparse
import os
import random
import subprocess
import sys
import tempfile
import zlib
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from importlib.util import find_spec
from pathlib import Path
from typing import Final

from places import ROOT

STORE: Final = ROOT / "out" / "fuzz"
"""Where inputs stay from one time to the next."""
BROKEN: Final = STORE / "broken"
TEXTS_AND_FILES: Final = (
    *("program", "iso", "pmac", "fix", "iso-fix", "convert", "scenario", "machine", "settings", "baseline", "dialect"),
    *("trace", "editor", "card", "dxf"),
)
"""Targets whose input is one text or file.

Of a whole run too little is learnt in its time. Loops and stored results are none: atheris sees the digest that
their seal is compared with, and writes it; a forged seal is no damage.
"""
SEEDS: Final = 100
"""Inputs that a target begins with, those of the first numbers of `fuzz.py`."""
MOST_BYTES: Final = 4000
"""Longest input; what matters about long ones is their time, and `HOSTILE` holds those."""
PACKAGES: Final = (
    *("parser", "controller", "sim.base", "sim.check", "sim.setup", "sim.make", "sim.clients", "sim.serve", "sim.jobs"),
    "sim.show.findings",
)
"""Packages of which it is seen what an input reaches; loops are compiled as they stand in their files."""


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--target", choices=TEXTS_AND_FILES, action="append", help="this one, in place of all")
    options.add_argument("--seconds", type=int, default=600, help="of each target")
    options.add_argument("--workers", type=int, default=os.cpu_count() or 1, help="targets side by side")
    options.add_argument("--file", type=Path, help="try this input alone")
    options.add_argument("--alone", action="store_true", help=argparse.SUPPRESS)
    asked = options.parse_args()
    targets = asked.target or TEXTS_AND_FILES
    if asked.file is not None and len(targets) != 1:
        options.error("--file needs one --target")
    if asked.file is not None:
        sys.exit(bool(_judged_once(targets[0], asked.file.read_bytes())))
    if asked.alone:
        _fuzz(targets[0], asked.seconds)
    if find_spec("atheris") is None:
        options.error("atheris is not installed; `make guided` installs it, where it has a wheel")
    sys.exit(_side_by_side(targets, asked.seconds, asked.workers))


def _side_by_side(targets: Sequence[str], seconds: int, workers: int) -> int:
    """Each target in a process of its own, as libFuzzer ends its process; 1 where a promise was broken."""
    before = set(BROKEN.glob("*"))
    with ThreadPoolExecutor(workers) as threads:
        for target, last in zip(targets, threads.map(lambda name: _process(name, seconds), targets), strict=True):
            print(f"{target:10}{last}", flush=True)
    found = sorted(set(BROKEN.glob("*")) - before)
    for path in found:
        print(f"broke a promise: {path.relative_to(ROOT)}")
    return 1 if found else 0


def _process(target: str, seconds: int) -> str:
    """Fuzz one target; what libFuzzer says at the end."""
    command = [sys.executable, __file__, "--alone", "--target", target, "--seconds", str(seconds)]
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", check=False)
    lines = done.stderr.splitlines()
    told = [line for line in lines if line.startswith("#") and " cov: " in line]
    if done.returncode or not told:
        return f"ended with {done.returncode}: {' | '.join(lines[-3:])}"
    return told[-1].split("exec/s")[0].strip()


def _fuzz(target: str, seconds: int) -> None:
    """Fuzz in this process, which ends with it.

    What is fuzzed is imported here, where atheris sees which code an input reaches.
    """
    import atheris

    from sim.cli.compile import LOOPS

    with atheris.instrument_imports(include=list(PACKAGES), exclude=list(LOOPS), enable_loader_override=False):
        from fuzzing.targets import TARGETS
    from fuzzing.mutate import damaged
    from fuzzing.target import SEED

    makes = TARGETS[target]
    corpus = STORE / target
    corpus.mkdir(parents=True, exist_ok=True)
    seeds = [bytes(makes.input(SEED, number)) for number in range(SEEDS)]
    for seed in seeds:
        (corpus / f"{zlib.crc32(seed):08x}").write_bytes(seed[:MOST_BYTES])
    known: set[str] = set()

    def judge(data: bytes) -> None:
        for promise in _judged_once(target, data):
            if promise not in known:
                known.add(promise)
                BROKEN.mkdir(parents=True, exist_ok=True)
                (BROKEN / f"{target}-{zlib.crc32(data):08x}").write_bytes(data)

    def changed(data: bytes, most: int, number: int) -> bytes:
        rng = random.Random(number)
        way = rng.random()
        if way < 0.1:
            return bytes(makes.make(rng))[:most]
        if way < 0.5:
            return damaged(rng, data, seeds, (1, 1, 2, 5))[:most]
        return bytes(atheris.Mutate(data, most))

    arguments = [f"-max_total_time={seconds}", f"-max_len={MOST_BYTES}", "-timeout=60", "-rss_limit_mb=4096"]
    atheris.Setup([__file__, *arguments, str(corpus)], judge, custom_mutator=changed)
    atheris.Fuzz()


def _judged_once(target: str, data: bytes) -> list[str]:
    """Promises that an input breaks, printed. Imports stand here because `_fuzz` has to come before them."""
    from fuzzing.target import SEED
    from fuzzing.targets import TARGETS
    from fuzzing.worker import Task, tried

    number = zlib.crc32(data)
    with tempfile.TemporaryDirectory() as folder:
        broken, _ = tried(Task(TARGETS[target], SEED, number, number + 1, data), number, Path(folder) / "input")
    for promise in broken:
        print(f"{target} {number:08x}: {promise}", flush=True)
    return broken


if __name__ == "__main__":
    main()
