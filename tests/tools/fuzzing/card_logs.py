"""Target `card`: logs of the emulated card, replayed."""

import json
import random
import re
from functools import cache
from io import StringIO
from pathlib import Path
from typing import Any

from controller import GECard
from controller.card.core.settings import CardSettings, Switches
from controller.card.log import OWN, CardLog
from fuzzing.mutate import TEXTS, damaged, edited, number_text
from fuzzing.ran import answer_of, broken_by, ran
from fuzzing.target import Input, Judged

_NAMES = (*OWN, *(name for name in dir(GECard) if name.startswith("GT_")))
_CALL = re.compile(r"(\S+ +)([0-9a-f]+ )(\w+)\((.*)\) = (.*)")
_TIMES = ("0.0", "1e-05", "-1.0", "nan", "inf", "1e300", "0", "abc", "1_0")
_ANSWERS = ("0", "1", "7", "None", "(0, 0)", "-1", "'a'", "True", "nan", "(((", "9" * 5000)
_END = ("t_s", "status", "places", "pulses", "more")
_MOST_MS = 20_000
"""Sleeps are drawn up to this, so that most logs run on to their end."""


@cache
def seeds() -> tuple[str, ...]:
    """Logs of short sessions with all kinds of calls."""
    return tuple(_session(number) for number in range(4))


def _session(kind: int) -> str:
    switches = (Switches(-5000.0, 8000.0, (-100.0, 50.5), 1000.0), Switches())
    settings = CardSettings(axes=3, cards=2, switches=switches) if kind % 2 else CardSettings()
    stream = StringIO()
    log = CardLog(stream, settings)
    card = GECard(settings, on_pulses=log.count, on_call=log)
    card.GT_Open()
    for axis in (1, 2):
        card.GT_ClrSts(axis)
        card.GT_AxisOn(axis)
        card.GT_ZeroPos(axis)
    card.GT_StrtList()
    card.GT_MvXY(0.0, 0.0, 2.0, 0.5)
    card.GT_LnXY(300.0, 0.0)
    card.GT_ArcXY(300.0, 100.0, 90.0)
    if kind >= 2:
        card.step_block(0, 100, 100, 1, 1, 0, 100.0)
    card.GT_EndList()
    card.GT_StrtMtn()
    card.sleep(50.0)
    card.GT_StpMtn()
    card.GT_GetPrfPnt()
    card.sleep(200.0)
    card.GT_RestoreMtn()
    card.sleep(2000.0)
    card.GT_GetCrdSts()
    card.set_input(15, 0)
    card.GT_GetAtlPos(1)
    card.GT_Close()
    log.close(card)
    return stream.getvalue()


def make(rng: random.Random) -> Input:
    """A log."""
    text = rng.choice(seeds())
    if rng.random() < 0.1:
        return damaged(rng, text.encode(), [seed.encode() for seed in seeds()])
    first, settings, *calls, end = text.splitlines()
    for _ in range(rng.choice((1, 2, 4, 8))):
        what = rng.random()
        if what < 0.1:
            settings = _other_settings(rng, settings)
        elif what < 0.15:
            end = _other_end(rng, end)
        elif what < 0.5:
            calls.insert(rng.randint(0, len(calls)), _call(rng))
        else:
            calls = edited(rng, calls, lambda line: _other_call(rng, line))
    return "\n".join([first, settings, *calls, end, ""]).encode("utf-8", "surrogatepass")


def judge(data: Input, number: int, folder: Path) -> Judged:
    """A log is replayed to its end, or refused in a line."""
    assert isinstance(data, bytes)
    (folder / "part.log").write_bytes(data)
    as_json = number % 2 == 0
    done = ran(("card", "replay", "part.log", *(("--json",) if as_json else ())), folder)
    broken = broken_by(done, folder, "json" if as_json else "text")
    return Judged(answer_of(done, folder), list(broken), f"exit {done.returncode}")


def _call(rng: random.Random) -> str:
    arguments = ", ".join(_argument(rng) for _ in range(rng.choice((0, 1, 1, 2, 3, 4, 6, 8))))
    return f"{rng.choice(_TIMES):<24} 0001 {rng.choice(_NAMES)}({arguments}) = 0"


def _other_call(rng: random.Random, line: str) -> str:
    found = _CALL.fullmatch(line)
    if found is None:
        return line[: rng.randint(0, len(line))]
    time, status, name, arguments, answer = found.groups()
    what = rng.random()
    if what < 0.1:
        time = f"{rng.choice(_TIMES)} "
    elif what < 0.2:
        name = rng.choice((*_NAMES, "__init__", "GT_", "places", "close"))
    elif what < 0.85:
        arguments = ", ".join(edited(rng, arguments.split(", "), lambda _: _argument(rng)))
    elif what < 0.95:
        answer = rng.choice(_ANSWERS)
    else:
        status = f"{number_text(rng)} "
    return f"{time}{status}{name}({arguments}) = {answer}"


def _argument(rng: random.Random) -> str:
    what = rng.random()
    if what < 0.35:
        return str(rng.randint(-3, 8))
    if what < 0.6:
        return repr(rng.choice((rng.uniform(-1000, 1000), float(rng.randint(0, _MOST_MS)))))
    if what < 0.85:
        return number_text(rng)
    return rng.choice(
        (repr(rng.choice(TEXTS)[:400]), "None", "True", "()", "(1, 2)", "-nan", "1j", "f()", "b'a'", "[1]")
    )


def _other_settings(rng: random.Random, line: str) -> str:
    table: dict[str, Any] = json.loads(line.removeprefix("settings "))
    key = rng.choice(list(table))
    values = (*(None, [], {}, "inf", "-inf", "a", True), *(0, 1, -1, 2, 4, 16, 1e-5, 0.5, 1e300, 10**30, 1e6))
    table[rng.choice((key, key, key, "more"))] = rng.choice((*values, [{"home": [0.0, 1.0]}], [[]]))
    return f"settings {json.dumps(table)}"


def _other_end(rng: random.Random, line: str) -> str:
    table: dict[str, Any] = json.loads(line.removeprefix("end "))
    table[rng.choice(_END)] = rng.choice((None, 0, -1, "a", [], [[]], [["a"]], 1e300, {}, 10**30))
    return f"end {json.dumps(table)}"
