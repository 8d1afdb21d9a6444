"""How much longer cuts take in a shop: intervals hold as often as they say, against weighed random draws too."""

import math
from statistics import NormalDist

import numpy as np
import pytest
from depth import cases

from sim.measure.factor import LEVEL, PRIOR_SD, UNKNOWN, factor_of

FIVE = np.log([1.10, 1.18, 1.07, 1.21, 1.12])


def test_five_cuts_make_the_worked_middle_and_an_interval_no_narrower_than_with_a_known_scatter() -> None:
    """With σ = 0.0506 known the factor is 1.1342 (1.0354 … 1.2425)."""
    found = factor_of(FIVE)
    assert (found.level, found.from_cuts) == (0.9, 5)
    assert found.middle == pytest.approx(1.1342, abs=0.001)
    assert found.least < 1.0354
    assert found.most > 1.2425


def test_without_a_cut_the_factor_is_that_of_the_prior() -> None:
    found = factor_of(np.empty(0))
    assert found[:3] == (0.6, 1.0, 1.4)
    draws = np.exp(np.random.default_rng(1).normal(0.0, PRIOR_SD, 400_000))
    assert found.level == pytest.approx(np.mean(np.abs(draws - 1.0) <= UNKNOWN), abs=0.01)


def even_cuts(number: int) -> np.ndarray:
    """Logarithms of so many cuts that scatter by 10 % as a normal law has it, in no order."""
    shares = (np.random.default_rng(number).permutation(number) + 0.5) / number
    return np.array([0.1 + 0.1 * NormalDist().inv_cdf(share) for share in shares])


@pytest.mark.parametrize(("log_ratios", "extra_sd"), [(FIVE, 0.0), (FIVE[:1], 0.0), (np.log([0.7, 1.3, 0.9]), 0.2)])
def test_quantiles_are_those_of_weighed_draws(log_ratios: np.ndarray, extra_sd: float) -> None:
    """Shops drawn from the prior, each weighed by how well it explains the log; a new cut is drawn of each."""
    chance = np.random.default_rng(7)
    mean = chance.normal(0.0, PRIOR_SD, 400_000)
    scatter = np.exp(chance.normal(math.log(0.12), 0.7, len(mean)))
    off = (log_ratios[:, None] - mean) / scatter
    weight = np.exp(-0.5 * (off**2).sum(axis=0)) / scatter ** len(log_ratios)
    new = mean + np.hypot(scatter, extra_sd) * chance.normal(size=len(mean))
    order = np.argsort(new)
    share = np.cumsum(weight[order]) / weight.sum()
    wanted = np.exp(new[order][np.searchsorted(share, [0.05, 0.5, 0.95])])
    assert factor_of(log_ratios, extra_sd)[:3] == pytest.approx(wanted, rel=0.015)


@pytest.mark.alike(3)
@pytest.mark.parametrize("number", [1, 3, 5, 12, 19, 20, 25, 60, 200])
def test_the_interval_holds_a_new_cut_in_nine_of_ten(number: int) -> None:
    """Shops 0.6 to 1.6 times as slow whose cuts scatter by 5 to 25 %."""
    chance = np.random.default_rng(number)
    many = len(cases(400, 4000))
    held = 0
    for _ in range(many):
        mean, scatter = math.log(chance.uniform(0.6, 1.6)), chance.uniform(0.05, 0.25)
        found = factor_of(mean + scatter * chance.normal(size=number))
        new = math.exp(mean + scatter * chance.normal())
        held += found.least <= new <= found.most
    assert held / many == pytest.approx(LEVEL, abs=0.02 + 2.0 * math.sqrt(0.09 / many))


def test_more_cuts_make_it_narrower_and_what_no_cut_was_like_wider() -> None:
    widths = [math.log(found.most / found.least) for found in map(factor_of, map(even_cuts, (2, 6, 18)))]
    assert widths == sorted(widths, reverse=True)
    for number in (4, 200):
        usual, other = factor_of(even_cuts(number)), factor_of(even_cuts(number), 0.35)
        assert other.least < usual.least < usual.middle < usual.most < other.most
        assert other.middle == pytest.approx(usual.middle, rel=0.01)


def test_of_many_cuts_together_the_scatter_evens_out_and_the_mean_does_not() -> None:
    cuts = np.log([1.0, 1.3, 1.1, 0.9, 1.2])
    alone, together = factor_of(cuts), factor_of(cuts, shares=np.full(400, 1.0 / 400.0))
    assert together.most / together.least < alone.most / alone.least
    only_mean = math.log(together.most / together.least) / 2.0 / 1.645
    assert only_mean == pytest.approx(np.std(cuts, ddof=1) / math.sqrt(5.0), rel=0.35)
