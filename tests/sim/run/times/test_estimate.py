"""Times of programs: terms that add up, however the path is divided, a log that is read as shops write it, costs."""

from dataclasses import replace
from decimal import Decimal
from pathlib import Path

import numpy as np
import pytest
from runs import plain_scenario, run_text

from parser.findings.errors import SettingsError
from parser.program import Program, load_program
from sim.run.times.cost import cost_of
from sim.run.times.estimate import estimated
from sim.run.times.log import Cut as Logged
from sim.run.times.log import Log, read_log
from sim.run.times.predicted import Predicted, predicted, predicted_way
from sim.setup.scenario import Scenario
from sim.setup.shop import Rates, Shop, ShopTimes, load_shop
from sim.setup.technology import Cut, Technology

SQUARE = "B60000B0B60000GXL1\nB0B60000B60000GYL2\nB60000B0B60000GXL3\nB0B60000B60000GYL4\n"
TWO_HOLES = "B900B0B900GXL1\nB900B0B3600GYNR1\nB900B0B900GXL3\nD\nB30000B0B30000GXL1\nD\n"
TWO_HOLES += "B900B0B900GXL1\nB900B0B3600GYNR1\nB900B0B900GXL3\nDD\n"
WORKED = (1.10, 1.18, 1.07, 1.21, 1.12)


def program(text: str) -> Program:
    return load_program(text.encode(), "part.3b")


def at_rate(mm2_min: float, thickness_mm: float = 40.0) -> Scenario:
    scenario = plain_scenario(thickness_mm=thickness_mm)
    return replace(scenario, machine=scenario.machine._replace(area_rate_mm2_min=mm2_min))


def log_of(folder: Path, text: str, usual: Scenario | None = None, encoding: str = "utf-8") -> Log:
    path = folder / "cuts.csv"
    path.write_text(text, encoding)
    return read_log(path, usual or at_rate(80.0), Shop())


def worked(folder: Path) -> Log:
    rows = [
        f"{length},40,1,{ratio * length * 40.0 / 80.0}"
        for length, ratio in zip((100, 50, 200, 70, 120), WORKED, strict=True)
    ]
    return log_of(folder, "\n".join(["length_mm,height_mm,passes,minutes", *rows]))


def test_the_worked_example_of_a_part_of_120_min(tmp_path: Path) -> None:
    part = predicted(program(SQUARE), at_rate(80.0), Shop())
    assert part.minutes == pytest.approx(120.0)
    done = estimated([part], worked(tmp_path), None)
    assert done.minutes.middle == pytest.approx(136.1, abs=0.1)
    assert done.minutes.least < 124.3
    assert done.minutes.most > 149.1
    assert (done.minutes.level, done.from_cuts) == (0.9, 5)
    assert sum(term.minutes for term in done.terms) == pytest.approx(done.minutes.middle)


def test_a_time_is_the_sum_of_its_programs_passes_and_blocks() -> None:
    scenario, shop = at_rate(80.0), Shop()
    once = predicted(program(SQUARE), scenario, shop)
    both = estimated([once, once], Log(), None)
    assert both.minutes.middle == pytest.approx(2.0 * once.minutes)
    assert predicted(program(SQUARE + SQUARE), scenario, shop).minutes == pytest.approx(2.0 * once.minutes)
    assert predicted_way(240.0, 2, scenario) == pytest.approx(2.0 * once.minutes)
    sides = ("B24B0B24GXL1", "B0B24B24GYL2", "B24B0B24GXL3", "B0B24B24GYL4")
    fine = "".join(f"{side}\n" * 2500 for side in sides)
    assert predicted(program(fine), scenario, shop).minutes == pytest.approx(once.minutes, rel=1e-3)
    assert predicted(program(SQUARE), at_rate(80.0, 10.0), shop).minutes == pytest.approx(once.minutes / 4.0)


def test_each_further_start_hole_is_threaded_and_terms_of_the_shop_are_added() -> None:
    times = ShopTimes(2.0, 0.5, 6.0, 1.0, 20.0, 0.5, 4.0)
    part = predicted(program(TWO_HOLES), at_rate(80.0), Shop(times, ("corner_wait_s",)))
    terms = {term.name: term for term in part.terms}
    assert terms["cut"].minutes == pytest.approx(2.0 * (1.8 + 1.8 * np.pi) * 40.0 / 80.0)
    assert terms["jumps"].minutes == pytest.approx(30.0 / 0.5 / 60.0)
    assert (terms["threading"].minutes, terms["threading"].times) == (2.0, 1)
    assert (terms["pierce"].minutes, terms["pierce"].times) == (1.0, 2)
    assert (terms["corners"].minutes, terms["corners"].times) == (0.4, 4)  # into each circle and out of it
    assert terms["reversals"].minutes == pytest.approx(terms["cut"].minutes / 20.0)
    assert terms["breaks"].minutes == pytest.approx(terms["cut"].minutes / 60.0 * 0.5 * 4.0)
    assert (terms["corners"].grade, terms["threading"].grade) == ("set", "assumed")


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "gbk"])
def test_a_log_is_read_as_spreadsheets_write_it(tmp_path: Path, encoding: str) -> None:
    (tmp_path / "part.3b").write_text(SQUARE)
    text = "Minutes;LENGTH_MM;height_mm;passes;备注\n66,0;120,0;;;好\n# no row\n;;;\n;50;40;1;还没切\n"
    log = log_of(tmp_path, text, at_rate(80.0, 20.0), encoding)
    assert log.not_cut == 1
    (cut,) = log.cuts
    assert (cut.line, cut.height_mm, cut.passes) == (2, 20.0, 1)
    assert cut.ratio == pytest.approx(66.0 / 30.0)


def test_programs_of_a_log_are_predicted_with_their_passes(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text(SQUARE)
    log = log_of(tmp_path, "program,height_mm,passes,minutes\npart.3b,40,,120\npart.3b,20,3,90\n")
    assert [(cut.passes, cut.height_mm, round(cut.ratio, 6)) for cut in log.cuts] == [(1, 40.0, 1.0), (3, 20.0, 0.5)]


@pytest.mark.parametrize(
    ("row", "code"),
    [
        ("x,,,1,3", "row-field"),
        (",1x,,1,3", "row-field"),
        (",10,,1.5,3", "row-field"),
        (",10,,1,-3", "row-field"),
        (",10,0,1,3", "row-field"),
        (",,40,1,3", "log-without-way"),
        ("cuts.csv,,40,1,3", "log-program-faulty"),
        (",inf,40,1,3", "row-field"),
    ],
)
def test_a_row_that_says_nothing_is_refused_with_its_line(tmp_path: Path, row: str, code: str) -> None:
    with pytest.raises(SettingsError) as raised:
        log_of(tmp_path, f"program,length_mm,height_mm,passes,minutes\n,10,40,1,5\n{row}\n")
    assert raised.value.message.code == code
    assert "cuts.csv:3:" in str(raised.value)


def test_what_no_cut_was_like_opens_the_interval_and_is_told(tmp_path: Path) -> None:
    log = worked(tmp_path)
    terms = predicted(program(SQUARE), at_rate(80.0), Shop()).terms
    usual, high, many = (
        estimated([Predicted("p", 1.0, height, passes, terms)], log, None)
        for height, passes in ((40.0, 1), (160.0, 1), (40.0, 4))
    )
    assert not usual.notes
    assert [note.name for note in high.notes] == ["outside-heights"]
    assert [note.name for note in many.notes] == ["unlike-passes"]
    for other in (high, many):
        assert other.minutes.most / other.minutes.least > usual.minutes.most / usual.minutes.least


def test_a_slip_in_the_log_is_named(tmp_path: Path) -> None:
    rows = "".join(f",100,40,1,{minutes}\n" for minutes in (55, 54, 56, 550, 57, 53))
    log = log_of(tmp_path, f"program,length_mm,height_mm,passes,minutes\n{rows}")
    assert [cut.line for cut in log.odd] == [5]


def test_a_cost_adds_up_to_the_cent() -> None:
    rates = Rates("CNY", 33.33, 17.0, 0.137, 1.7, 171.0, 77.0, 1.37, 0.913)
    chance = np.random.default_rng(5)
    for minutes in chance.uniform(0.1, 900.0, 200).tolist():
        cost = cost_of(0.9 * minutes, minutes, 1.2 * minutes, rates)
        assert sum(item.amount for item in cost.items) == cost.total
        exact = minutes / 60.0 * (33.33 + 1.37 * 0.913 + 171.0 / 77.0) + minutes * 1.7 * 0.137 + 17.0
        assert abs(float(cost.total) - exact) <= 0.02
        assert cost.least <= cost.total <= cost.most
        assert all(item.amount == item.amount.quantize(Decimal("0.01")) for item in cost.items)


def test_a_shop_file_is_read_and_what_is_wrong_in_it_named(tmp_path: Path) -> None:
    path = tmp_path / "shop.toml"
    path.write_text('[time]\nbreaks_per_h = 0.1\n[rates]\ncurrency = "元"\nper_hour = 35\n', "utf-8")
    shop = load_shop(path)
    assert (shop.given, shop.times.breaks_per_h, shop.rates and shop.rates.currency) == (("breaks_per_h",), 0.1, "元")
    for text in ("[time]\nfoo = 1\n", "[rates]\nper_hour = 1\n", "[time]\nbreak_min = -1\n", "x = 1\n", "time = 3\n"):
        path.write_text(text)
        with pytest.raises(SettingsError, match=r"shop\.toml"):
            load_shop(path)


def test_by_a_technology_a_time_has_the_interval_of_its_feeds_and_by_a_log_that_of_the_log() -> None:
    """At 2 (± 10 %) mm/min a way of 60 mm takes 30 min: 27.3 to 33; a program of the same run says the same."""
    row = Cut("steel", 180.0, 40.0, 1, 12.0, None, 2.0, None, 0.1, None, None, None, None, None, None)
    scenario = plain_scenario(technology=Technology("test", "measured", "here", (row,)))
    of = predicted(program("B60000B0B60000GXL1\nDD"), scenario, Shop())
    estimate = estimated([of, of], Log(), None)
    assert estimate.minutes == pytest.approx((60.0 / 1.1, 60.0, 66.0, 0.9))
    assert (estimate.technology, estimate.from_cuts) == (scenario.technology, 0)
    assert [term.grade for term in estimate.terms if term.name == "cut"] == ["measured"]
    ran = run_text("B60000B0B60000GXL1\nDD", technology=scenario.technology)
    assert ran.time_s == pytest.approx((1800.0 / 1.1, 1800.0, 1980.0, 0.9), rel=1e-3)
    logged = estimated([of], Log("log", tuple(Logged(at, 40.0, 1, 1.1) for at in range(5))), None)
    assert (logged.technology, logged.from_cuts) == (None, 5)
    assert predicted_way(60.0, 2, scenario) == pytest.approx(60.0)
