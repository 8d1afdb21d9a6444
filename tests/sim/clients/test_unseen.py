"""What a program did not look at: sessions of the card, told as programs make them, and what each is told of."""

import io
import time
from collections.abc import Callable
from typing import Any

import pytest

from controller import GECard
from controller.card.core.settings import CardSettings, Switches
from controller.card.log import CardLog, CardLogError
from sim.clients.run import Read, read_again
from sim.clients.session import session_of
from sim.clients.unseen import unseen_of

LIMITED = {"switches": (Switches(negative=-4000.0, positive=9000.0),)}


def read(work: Callable[[GECard], Any], *, is_cut: bool = False, **settings: Any) -> Read:
    """What is read of the log of a card that some work was done with; without its end where it is cut."""
    stream = io.StringIO()
    own = CardSettings(call_s=1e-3, **settings)
    log = CardLog(stream, own)
    card = GECard(own, on_call=log)
    card.GT_Open()
    card.GT_SetSynVel(10.0)
    card.GT_SetSynAcc(0.1)
    work(card)
    if not is_cut:
        log.close(card)
    lines = stream.getvalue().splitlines(keepends=True)
    return read_again("card.log", session_of("card.log", lines))


def codes(found: Read) -> list[str]:
    return [finding.code for finding in found.program.findings]


def wait(card: GECard) -> None:
    while not card.GT_GetCrdSts()[1] & 1:
        pass


def retry(card: GECard) -> None:
    card.GT_StrtList()
    card.GT_StrtMtn()
    for x in range(1, 30):
        while card.GT_LnXY(100.0 * x, 0.0) == 1:
            card.sleep(5.0)


def asks_why(card: GECard) -> None:
    card.GT_LnXY(5000.0, 0.0)
    card.GT_ZeroPos(1)
    card.GT_GetCmdSts()
    card.GT_SetSynVel(3.0)


def stops(card: GECard) -> None:
    card.GT_LnXY(0.0, 0.0)
    card.GT_Close()


def ends(card: GECard) -> None:
    card.GT_AxisOn(9)


def home_on_a_limit(card: GECard) -> None:
    card.GT_LnXY(-50_000.0, 0.0)
    while not card.GT_GetSts(1)[1] & 1 << 6:
        pass
    wait(card)
    card.GT_LnXY(0.0, 0.0)
    wait(card)


def clears_the_limit(card: GECard) -> None:
    card.GT_LnXY(50_000.0, 0.0)
    wait(card)
    card.GT_ClrSts(1)
    card.GT_LnXY(0.0, 0.0)


def sleeps_enough(card: GECard) -> None:
    card.GT_LnXY(5000.0, 0.0)
    card.sleep(2000.0)
    card.GT_ZeroPos(1)
    card.GT_LnXY(100.0, 0.0)


@pytest.mark.parametrize(
    "work",
    [retry, asks_why, stops, ends, home_on_a_limit, clears_the_limit, sleeps_enough],
    ids=lambda one: one.__name__,
)
def test_a_program_that_looks_is_told_nothing(work: Callable[[GECard], Any]) -> None:
    found = read(work, capacity=4, **LIMITED)
    assert codes(found) == []
    assert found.unseen.refusals == found.unseen.on_limit == found.unseen.short_sleeps == ()


def test_a_refused_call_is_told_with_what_the_program_went_on_with() -> None:
    def work(card: GECard) -> None:
        card.GT_LnXY(0.0, 0.0)
        card.GT_GetCrdSts()
        card.GT_SetSynVel(2.0)

    found = read(work)
    (finding,) = found.program.findings
    assert finding.code == "GEC401"
    assert finding.values == {
        "call": "GT_LnXY(0.0, 0.0)",
        "answer": 3,
        "function": "GT_LnXY",
        "then": "GT_SetSynVel(2.0)",
    }
    assert found.program.excerpt(finding.line).split() == ["0.003000", "GT_LnXY(0.0,", "0.0)", "=", "3"]


def test_a_refused_question_is_told_too() -> None:
    def work(card: GECard) -> None:
        card.GT_GetSts(7)
        card.GT_GetSts(1)
        card.GT_LnXY(10.0, 0.0)

    assert codes(read(work)) == ["GEC401"]


def test_a_motion_that_ended_on_a_limit_is_told_where_nobody_asked() -> None:
    def work(card: GECard) -> None:
        card.GT_LnXY(50_000.0, 0.0)
        wait(card)
        card.GT_LnXY(0.0, 0.0)
        wait(card)
        card.GT_LnXY(-50_000.0, 0.0)

    found = read(work, **LIMITED)
    assert codes(found) == ["GEC402", "GEC402"]
    assert [one.met.is_positive for one in found.unseen.on_limit] == [True, False]
    assert [one.then is None for one in found.unseen.on_limit] == [False, True]
    # From rest at 0.1 pulse/ms² to 10 pulse/ms in 100 ms and 500 pulses; at 9000 after 850 ms more.
    assert found.unseen.on_limit[0].met.t_s == pytest.approx(0.004 + 0.95, abs=2e-3)


def test_a_sleep_that_is_too_short_is_told_once_with_all_that_was_refused() -> None:
    def work(card: GECard) -> None:
        card.GT_LnXY(20_000.0, 0.0)
        card.sleep(1500.0)
        card.GT_ZeroPos(1)
        card.GT_ZeroPos(2)
        card.GT_LnXY(0.0, 0.0)
        card.sleep(5000.0)

    found = read(work)
    (sleep,) = found.unseen.short_sleeps
    assert codes(found) == ["GEC403"]
    assert len(sleep.refused) == 3
    assert len(found.unseen.refusals) == 2, "behind the third it only waits"
    # 20,000 pulses at 10 pulse/ms with two ramps of 100 ms take 2.1 s, 1 ms of which was the call.
    assert (sleep.slept_s, sleep.needed_s) == (1.5, pytest.approx(2.1, abs=2e-3))


def test_a_sleep_after_which_the_program_asked_is_no_short_one() -> None:
    def work(card: GECard) -> None:
        card.GT_LnXY(20_000.0, 0.0)
        card.sleep(1000.0)
        card.GT_GetCrdSts()
        card.GT_ZeroPos(1)
        card.GT_LnXY(0.0, 0.0)

    found = read(work)
    assert found.unseen.short_sleeps == ()
    assert codes(found) == ["GEC401"], "of ZeroPos; the line is the last call"


def test_a_log_that_breaks_off_is_read_as_far_as_it_goes() -> None:
    def work(card: GECard) -> None:
        card.GT_LnXY(2000.0, 0.0)

    whole, cut = read(work), read(work, is_cut=True)
    assert (whole.session.is_whole, cut.session.is_whole) == (True, False)
    assert whole.session.events == cut.session.events
    assert cut.again.places == [[2000, 0, 0, 0]]
    assert cut.again.went_on_s == pytest.approx(0.3, abs=2e-3), "2,000 pulses at 10 pulse/ms, two ramps of 100 ms"


def test_questions_are_counted_and_not_made_again() -> None:
    def work(card: GECard) -> None:
        card.GT_LnXY(2000.0, 0.0)
        wait(card)

    found = read(work)
    assert len(found.session.events) < 8
    assert found.session.calls > 250
    assert "? GT_GetCrdSts() ×" in found.program.text


@pytest.mark.deeper
def test_many_refusals_are_looked_at_in_time_that_grows_with_them() -> None:
    """A full list refuses each entry some hundred times; the next one is found among the tries that follow."""

    def work(card: GECard) -> None:
        card.GT_StrtList()
        card.GT_StrtMtn()
        for x in range(1, 400):
            card.GT_AddList()
            while card.GT_LnXY(100.0 * (x % 2), 50.0 * x) == 1:
                card.GT_EndList()
                card.GT_AddList()
            card.GT_EndList()

    found = read(work, capacity=2)
    assert found.unseen.refused > 2000
    assert codes(found) == []


@pytest.mark.deeper
def test_sleeps_before_many_refusals_are_looked_at_in_time_that_grows_with_them() -> None:
    def work(calls: int) -> Callable[[GECard], None]:
        def polls(card: GECard) -> None:
            card.GT_LnXY(1e6, 0.0)
            for _ in range(calls):
                card.sleep(1.0)
                card.GT_LnXY(0.0, 0.0)

        return polls

    took = []
    for calls in (1000, 8000):
        found = read(work(calls))
        begin = time.process_time()
        assert len(unseen_of(found.session, found.again).short_sleeps) == 1
        took.append(time.process_time() - begin)
    assert took[1] < 30.0 * took[0] + 0.2  # 64 times as long where it grows with the square


def test_calls_to_another_card_are_not_about_the_first_one() -> None:
    def work(card: GECard) -> None:
        card.GT_LnXY(50_000.0, 0.0)
        wait(card)
        card.GT_SwitchtoCardNo(1)
        card.GT_Open()
        card.GT_SetSynVel(10.0)
        card.GT_SetSynAcc(0.1)
        card.GT_LnXY(100.0, 0.0)

    found = read(work, cards=2, **LIMITED)
    (limit,) = found.unseen.on_limit
    assert (limit.met.axis, limit.then) == (1, None)
    assert found.again.status & 1


@pytest.mark.parametrize("time_s", ["x", "nan", "1e300", "inf", "-1"])
@pytest.mark.parametrize("call", ["GT_GetSts(1) = (0, 1)", "GT_Open() = 0"])
def test_a_damaged_time_names_its_line(time_s: str, call: str) -> None:
    stream = io.StringIO()
    CardLog(stream, CardSettings())
    lines = [*stream.getvalue().splitlines(keepends=True), f"{time_s} 0000 {call}\n"]
    with pytest.raises(CardLogError, match=r"card\.log:3: the time"):
        session_of("card.log", lines)
