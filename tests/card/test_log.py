"""The log of a card and its replay: what was logged is repeated, and every change of a log is found."""

import inspect
import io
import json
import math
import time
from dataclasses import replace
from decimal import Decimal
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command import run_inside
from depth import examples
from hypothesis import given, settings
from hypothesis import strategies as st

from controller import GECard
from controller.card.calls.base import Logged
from controller.card.core.call import AxisSts
from controller.card.core.settings import CardSettings, Switches
from controller.card.log import (
    LONGEST_S,
    CardLog,
    CardLogError,
    Difference,
    Replay,
    call_of,
    call_text,
    replay_file,
    settings_from,
    settings_text,
)
from parser.findings.errors import DrycutError, FileUnreadableError

SWITCHES = (Switches(-5000.0, 8000.0, (-100.0, 50.5), 1000.0), Switches())
SETTINGS = CardSettings(axes=3, cards=2, call_s=1e-5, jerk_pulse_ms3=0.125, carries_speed=False, switches=SWITCHES)


def session() -> str:
    """Log of a session with all kinds of calls."""
    stream = io.StringIO()
    log = CardLog(stream, SETTINGS)
    card = GECard(SETTINGS, on_pulses=log.count, on_call=log)
    card.GT_GetExOpt()
    card.GT_Open()
    card.GT_SwitchtoCardNo(1)
    card.GT_GetCurrentCardNo()
    card.GT_SwitchtoCardNo(0)
    card.GT_ExOptBit(value=0, bit=3)
    card.set_input(15, 0)
    card.GT_SetKp(1, math.nan)
    card.GT_SetKp(1, np.float64(0.1))
    card.GT_RstSts(1, AxisSts.FINISHED)
    card.GT_InitLookAheadExx(1.0, 2.0, 3.0, 4, 5.0, 6.0, 'it\'s "a" file\n, 1) = 2')
    card.GT_StrtList()
    card.GT_MvXY(100.0, 50.25, 2.0, 0.5)
    card.GT_LnXY(1500.0, -200.5)
    card.GT_ArcXY(1500.0, 0.0, 90.0)
    card.step_block(0, 300, 300, 1, 1, 0, 300.0)
    card.GT_EndList()
    card.GT_StrtMtn()
    card.sleep(30.0)
    card.GT_StpMtn()
    card.GT_GetPrfPnt()
    card.sleep(500.0)
    card.GT_GetBrkPnt()
    card.GT_RestoreMtn()
    card.sleep(5000.0)
    card.GT_M30()
    card.GT_HookCommand(lambda name, code: card.GT_GetCmdSts())
    card.GT_GetSts(1)
    log.close(card)
    return stream.getvalue()


def replayed(text: str) -> list[Difference]:
    return list(Replay("part.log", text.splitlines()))


def test_a_log_is_repeated_to_the_last_digit() -> None:
    text = session()
    assert replayed(text) == []
    again = Replay("part.log", text.splitlines())
    assert list(again) == []
    assert again.calls == len(text.splitlines()) - 3
    assert again.pulses > 1500
    assert json.loads(text.splitlines()[-1].removeprefix("end "))["pulses"] == again.pulses


def test_a_log_is_readable() -> None:
    lines = session().splitlines()
    assert lines[0] == "drycut card log 1"
    assert lines[3] == "1e-05                    2001 GT_Open(65535) = 0"
    assert "set_input(15, 0) = None" in lines[8]
    assert any("GT_RstSts(1, 1) = 0" in line for line in lines)
    assert any("GT_SetKp(1, 0.1) = 0" in line for line in lines)


HOSTILE = st.sampled_from(
    [0, 1, 2, 7, -1, 1 << 40, 1.5, -3.0, 1e300, math.nan, None, "1", b"1", (), True, Decimal("1.5")]
)
FITTING = st.one_of(st.integers(0, 4), st.floats(-1e3, 1e3))
PARAMETERS = {
    name: len(inspect.signature(getattr(GECard, name)).parameters) - 1
    for name in [*filter(lambda name: name.startswith("GT_"), dir(GECard)), "step_block"]
}


@settings(max_examples=examples(40))
@given(st.data())
@pytest.mark.parametrize("arguments", [HOSTILE, FITTING], ids=["hostile", "fitting"])
def test_any_session_is_repeated(arguments: st.SearchStrategy[Any], data: st.DataObject) -> None:
    stream = io.StringIO()
    log = CardLog(stream, SETTINGS)
    card = GECard(SETTINGS, on_call=log)
    card.GT_Open()
    for name in data.draw(st.lists(st.sampled_from(sorted(PARAMETERS)), max_size=40)):
        getattr(card, name)(*(data.draw(arguments) for _ in range(PARAMETERS[name])))
        card.sleep(data.draw(st.sampled_from([0.0, 1.0, 100.0])))
    log.close(card)
    assert replayed(stream.getvalue()) == []


def test_two_sessions_write_the_same_bytes() -> None:
    assert session() == session()


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("GT_ExOptBit(3, 0) = 0", "GT_ExOptBit(3, 0) = 7"),
        ("GT_GetCurrentCardNo() = 1", "GT_GetCurrentCardNo() = 0"),
        ("2001 GT_SetKp(1, 0.1)", "0001 GT_SetKp(1, 0.1)"),
        ("1e-05                    2001 GT_Open", "2e-05                    2001 GT_Open"),
        ("GT_LnXY(1500.0, -200.5)", "GT_LnXY(1500.0, -210.25)"),
        ("sleep(30.0)", "sleep(31.0)"),
        ('"status": "2001"', '"status": "0001"'),
        ('"pulses": ', '"pulses": 1'),
    ],
)
def test_what_was_changed_is_found_where_it_was_changed(old: str, new: str) -> None:
    text = session()
    assert text.count(old) == 1
    found = replayed(text.replace(old, new))
    lines = text.splitlines()
    changed = next(number for number, line in enumerate(lines, start=1) if old in line)
    assert changed <= found[0].line
    assert found[0].found != found[0].expected


def test_a_change_of_an_answer_is_one_difference() -> None:
    (found,) = replayed(session().replace("GT_ExOptBit(3, 0) = 0", "GT_ExOptBit(3, 0) = 7"))
    assert found.expected.endswith("GT_ExOptBit(3, 0) = 7")
    assert found.found.endswith("GT_ExOptBit(3, 0) = 0")


def test_pulses_that_the_log_was_not_told_are_not_compared() -> None:
    stream = io.StringIO()
    log = CardLog(stream, CardSettings())
    card = GECard(on_call=log)
    card.GT_Open()
    card.GT_LnXY(3.0, 4.0)
    card.sleep(1000.0)
    log.close(card)
    assert '"pulses": null' in stream.getvalue()
    assert replayed(stream.getvalue()) == []


NUMBERS = st.one_of(st.integers(), st.floats(allow_nan=False), st.text(), st.none())
VALUES = st.recursive(NUMBERS, lambda inner: st.lists(inner, max_size=4).map(tuple), max_leaves=8)


@given(st.floats(0.0, LONGEST_S), st.lists(VALUES, max_size=5).map(tuple), VALUES, st.integers(0, 0xFFFF))
def test_every_call_reads_back_as_it_was_written(
    t_s: float, arguments: tuple[object, ...], answer: object, status: int
) -> None:
    call = Logged(t_s, "GT_Any", arguments, answer, status)
    text = call_text(call)
    assert "\n" not in text
    assert call_of(text) == call


@pytest.mark.parametrize("given_settings", [CardSettings(), SETTINGS, replace(SETTINGS, axes=2, cards=16)])
def test_settings_read_back(given_settings: CardSettings) -> None:
    assert settings_from(settings_text(given_settings)) == given_settings


GOOD = session().splitlines()


@pytest.mark.parametrize(
    ("number", "line", "message"),
    [
        (1, "drycut card log 2", "part.log:1: the first line"),
        (2, "settings", "part.log:2: the second line"),
        (2, "settings {", "part.log:2: the settings are no JSON"),
        (2, "settings []", "part.log:2: settings are a table"),
        (2, 'settings {"axis": 4}', "part.log:2: settings have no key 'axis'"),
        (2, 'settings {"axes": 5}', "part.log:2: axes of a card is a whole number from 2 to 4, not 5"),
        (2, 'settings {"axes": true}', "part.log:2: axes is of kind int"),
        (2, 'settings {"cards": 1000000}', "part.log:2: cards of a card is"),
        (2, 'settings {"call_s": "soon"}', "part.log:2: call_s is of kind float"),
        (2, 'settings {"call_s": NaN}', "part.log:2: call_s of a card is from 1e-30 to 1, not nan"),
        (2, 'settings {"switches": [{"index_every": -1}]}', "part.log:2: index_every of a card is from 1"),
        (2, 'settings {"switches": 1}', "part.log:2: switches are a list"),
        (2, 'settings {"switches": [{"home": [1]}]}', "part.log:2: home is two places"),
        (2, 'settings {"switches": [{"home": [1, "x"]}]}', "part.log:2: home is two places"),
        (2, "settings " + "[" * 100_000, "part.log:2: the settings are nested too deep"),
        (4, "", "part.log:4: no call"),
        (4, "now 2001 GT_Open(65535) = 0", "part.log:4: the time is a number"),
        (4, "0.1 2001 GT_Open(65535)", "part.log:4: no call"),
        (4, "0.1 xyz GT_Open(65535) = 0", "part.log:4: no call"),
        (4, "0.1 2001 GT_Open(__import__('os')) = 0", "part.log:4: no number, text or tuple"),
        (4, "0.1 2001 GT_Open(-'1') = 0", "part.log:4: no number, text or tuple"),
        (4, "0.1 2001 GT_Open(" + "(" * 100_000 + ") = 0", "part.log:4: no number, text or tuple"),
        (4, "0.1 2001 GT_Open(1, 2) = 0", "part.log:4: the card has no function GT_Open of 2 arguments"),
        (4, "0.1 2001 GT_Nothing() = 0", "part.log:4: the card has no function GT_Nothing of 0"),
        (4, "0.1 2001 __init__() = 0", "part.log:4: no call"),
        (4, "0.1 2001 servo(1) = 0", "part.log:4: the card has no function servo"),
        (4, "0.1 2001 sleep(-1) = None", "part.log:4: a sleep takes"),
        (4, "0.1 2001 sleep('x') = None", "part.log:4: a sleep takes a number of ms, not 'x'"),
        (4, "0.1 2001 set_input(16, 0) = None", "part.log:4: an input is"),
        (len(GOOD), "end {}", f"part.log:{len(GOOD)}: the last line"),
        (len(GOOD), "end []", f"part.log:{len(GOOD)}: the last line"),
        (len(GOOD), GOOD[-1] + "\nmore", f"part.log:{len(GOOD) + 1}: nothing comes after"),
    ],
)
def test_a_damaged_log_is_named_with_its_line(number: int, line: str, message: str) -> None:
    lines = [*GOOD[: number - 1], line, *GOOD[number:]]
    with pytest.raises(CardLogError) as caught:
        replayed("\n".join(lines))
    assert str(caught.value).startswith(message)
    assert isinstance(caught.value, DrycutError)


@pytest.mark.parametrize("lines", [0, 1, 2, 5, len(GOOD) - 1])
def test_a_log_that_breaks_off_is_told(lines: int) -> None:
    with pytest.raises(CardLogError, match=r"part\.log: the log breaks off"):
        replayed("\n".join(GOOD[:lines]))


def test_files_that_are_no_logs_are_errors_for_people(tmp_path: Path) -> None:
    with pytest.raises(FileUnreadableError, match="cannot be read"):
        replay_file(tmp_path / "none.log")
    (tmp_path / "raw.log").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(CardLogError, match="no text in UTF-8"):
        replay_file(tmp_path / "raw.log")


@given(st.integers(0, len(GOOD) - 1), st.data())
def test_no_damage_of_a_line_is_a_traceback(number: int, data: st.DataObject) -> None:
    line = GOOD[number]
    at = data.draw(st.integers(0, len(line)))
    damaged = line[:at] + data.draw(st.text(max_size=4)) + line[at + data.draw(st.integers(0, 4)) :]
    try:
        replayed("\n".join([*GOOD[:number], damaged, *GOOD[number + 1 :]]))
    except DrycutError as error:
        assert str(error).startswith("part.log")  # noqa: PT017 - an error is allowed, not asked for


def test_logging_takes_microseconds_a_call() -> None:
    call, stream = Logged(12.34567890123, "GT_LnXY", (1234.5, 0.25), 0, 0x2001), io.StringIO()
    log, best = CardLog(stream, CardSettings()), math.inf
    for _ in range(5):
        began = time.process_time()
        for _ in range(10_000):
            log(call)
        best = min(best, (time.process_time() - began) / 10_000)
    assert best < 30e-6, "about 3 µs on a quiet machine"


def test_the_command_tells_that_all_is_equal(tmp_path: Path) -> None:
    (tmp_path / "part.log").write_text(session(), "utf-8")
    done = run_inside("card", "replay", "part.log", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, b"")
    text = done.stdout.decode()
    assert text.startswith("part.log: equal: 29 calls, 5.5")
    assert text.rstrip().endswith("status 2001")


def test_the_command_shows_the_first_differences(tmp_path: Path) -> None:
    (tmp_path / "part.log").write_text(session().replace(" 2001 ", " 2002 "), "utf-8")
    done = run_inside("card", "replay", "part.log", cwd=tmp_path)
    text = done.stdout.decode()
    assert done.returncode == 1
    assert text.startswith(
        "part.log:3: error: the card differs\n  expected: 0.0                      2002 GT_GetExOpt()"
    )
    (tmp_path / "part.log").write_text(session().replace("e-05", "e-06"), "utf-8")
    assert run_inside("card", "replay", "part.log", cwd=tmp_path).returncode == 1


def test_no_more_than_20_differences_are_shown(tmp_path: Path) -> None:
    lines = session().splitlines()
    call = next(line for line in lines if "GT_GetExOpt" in line)
    many = [lines[0], lines[1], *[call] * 30, lines[-1]]
    (tmp_path / "part.log").write_text("\n".join(many), "utf-8")
    done = run_inside("card", "replay", "part.log", "--json", cwd=tmp_path)
    result = json.loads(done.stdout)
    assert done.returncode == 1
    assert (result["equal"], result["calls"], result["differences"]) == (False, 30, 30)
    assert [entry["line"] for entry in result["first"]] == [*range(4, 24)]
    text = run_inside("card", "replay", "part.log", cwd=tmp_path).stdout.decode()
    assert "part.log: and 10 more\n" in text
    assert "part.log: 30 differences: 30 calls" in text


@pytest.mark.parametrize("name", ["none.log", "."])
def test_the_command_ends_with_2_for_what_it_cannot_read(tmp_path: Path, name: str) -> None:
    done = run_inside("card", "replay", name, cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr.decode().startswith(f"drycut: error: {name}: cannot be read")
    assert done.stdout == b""
