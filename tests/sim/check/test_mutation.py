"""Faults are found: at least so many of each kind, a little fewer than were measured (docs/check.md)."""

import random

import pytest
from cam_programs import sound_program
from mutants import KINDS
from mutation import tally, trials

from sim.check.batch import Job, check_file
from sim.check.settings import CheckSettings

DAMAGED = ("B lost", "G lost", "X or Y of G lost", "letter of sense lost")
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
_MUTANTS = 40
_RARELY_MOVED = {"D lost": 120}  # most programs have no D, and one that is left tells of the other


@pytest.mark.parametrize("kind", AT_THE_BLOCK)
def test_faults_of_every_kind_are_named_at_their_block(kind: str) -> None:
    done = list(trials(random.Random(f"mutants of {kind}"), _RARELY_MOVED.get(kind, _MUTANTS), kind))
    for printed, least in zip((False, True), AT_THE_BLOCK[kind], strict=True):
        n = tally(done, printed=printed)[kind]
        assert n["moved"] > 0
        assert n["block"] >= least * n["moved"]
        named = ANYWHERE.get(kind, (0.0, 0.0))[printed]
        assert n["moved"] - n["missed"] >= named * n["moved"]


@pytest.mark.parametrize("kind", DAMAGED)
def test_damaged_text_fails_without_fail(kind: str) -> None:
    done = trials(random.Random(f"damage of {kind}"), 10, kind)
    assert all(trial.is_error and trial.caught == "block" for trial in done)


def test_a_program_without_its_end_code_says_so() -> None:
    for trial in trials(random.Random(1), 6, "DD lost"):
        result = check_file(Job("a.3b", trial.text.encode(), CheckSettings()))
        assert [finding.code for finding in result.findings] == ["3B102"]


@pytest.mark.parametrize("printed", [False, True])
def test_sound_programs_are_silent(printed: bool) -> None:
    rng = random.Random(2)
    for _ in range(60):
        sound = sound_program(rng, printed=printed)
        assert check_file(Job("a.3b", sound.text.encode(), CheckSettings())).findings == (), sound.text


def test_every_kind_of_fault_is_held_to_a_rate_or_known_to_be_harmless() -> None:
    assert set(KINDS) - set(AT_THE_BLOCK) == {"D early", "DD lost", "label changed"}
