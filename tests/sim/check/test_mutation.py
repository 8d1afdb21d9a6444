"""Faults are found: at least so many of each kind, a little fewer than were measured (docs/check.md)."""

import random
from functools import cache

import pytest
from cam_programs import Sound, sound_program
from depth import cases
from mutants import KINDS
from mutation import tally, trials

from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings

DAMAGED = ("B lost", "G lost", "X or Y of G lost", "letter of sense lost", "O for 0")
AT_THE_BLOCK = {
    **dict.fromkeys(DAMAGED, (1.0, 1.0)),
    **dict.fromkeys(("GX for GY", "DD early", "jump lost"), (0.9, 0.95)),
    "D lost": (0.8, 0.8),  # a jump in the direction of the figure's first side looks like an overcut
    **dict.fromkeys(("J digit changed", "J digit lost", "J digit doubled"), (0.8, 0.95)),
    **dict.fromkeys((f"{field} digit {how}" for field in "XY" for how in ("changed", "lost", "doubled")), (0.65, 0.8)),
    **dict.fromkeys(("quadrant", "L for NR, SR", "NR for SR"), (0.65, 0.85)),
    "block deleted": (0.0, 0.6),
    "block doubled": (0.0, 0.95),
    "neighbours swapped": (0.0, 0.95),
}
"""Kind -> least share of mutants that are named at their block, without and with printed ends."""
ANYWHERE = {"block deleted": (0.45, 0.7), "block doubled": (0.5, 0.95)}
"""Kind -> least share that is named at all."""
_PROGRAMS = 120
_MUTANTS = len(cases(12, 40))
_RARELY_MOVED = {
    "D lost": 120,
    "quadrant": len(cases(24, 40)),
    "NR for SR": len(cases(24, 40)),
}  # most have no D, and few these words


@cache
def sound(number: int) -> tuple[Sound, ...]:
    """So many sound programs, half of them with printed ends: faults of all kinds are planted in the same."""
    rng = random.Random("sound programs")
    return tuple(sound_program(rng, printed=at % 2 == 1) for at in range(number))


def programs(rng: random.Random, number: int) -> list[Sound]:
    """Some of the sound ones, half of them with printed ends."""
    halves = (rng.sample(sound(_PROGRAMS)[half::2], number // 2) for half in (0, 1))
    return [program for half in halves for program in half]


@pytest.mark.alike(3)
@pytest.mark.deep
@pytest.mark.parametrize("kind", AT_THE_BLOCK)
def test_faults_of_every_kind_are_named_at_their_block(kind: str) -> None:
    rng = random.Random(f"mutants of {kind}")
    done = list(trials(rng, programs(rng, _RARELY_MOVED.get(kind, _MUTANTS)), kind))
    for printed, least in zip((False, True), AT_THE_BLOCK[kind], strict=True):
        n = tally(done, printed=printed)[kind]
        assert n["moved"] > 0
        assert n["block"] >= least * n["moved"]
        named = ANYWHERE.get(kind, (0.0, 0.0))[printed]
        assert n["moved"] - n["missed"] >= named * n["moved"]


@pytest.mark.parametrize("kind", DAMAGED)
def test_damaged_text_fails_without_fail(kind: str) -> None:
    rng = random.Random(f"damage of {kind}")
    done = trials(rng, programs(rng, 10), kind)
    assert all(trial.is_error and trial.caught == "block" for trial in done)


def test_a_program_without_its_end_code_says_so() -> None:
    rng = random.Random(1)
    for trial in trials(rng, programs(rng, 6), "DD lost"):
        result = check_file(Job("a.3b", trial.text.encode(), CheckSettings()))
        assert [finding.code for finding in result.findings] == ["3B102"]


@pytest.mark.alike(1)
@pytest.mark.parametrize("printed", [False, True])
def test_sound_programs_are_silent(printed: bool) -> None:
    for program in sound(_PROGRAMS)[printed::2]:
        assert check_file(Job("a.3b", program.text.encode(), CheckSettings())).findings == (), program.text


def test_every_kind_of_fault_is_held_to_a_rate_or_known_to_be_harmless() -> None:
    assert set(KINDS) - set(AT_THE_BLOCK) == {"D early", "DD lost"}
