"""How many faults `drycut check` finds: ``PYTHONPATH=. python tests/tools/mutation.py``, `make mutate`.

Sound programs as a CAM writes them, with and without printed ends, are broken in one place at random. A mutant counts
where its decoded path leaves that of the sound program by more than 5 µm, or cuts what was a jump. The table says, for
each kind of fault, how many of those are named at the broken block, how many by a finding elsewhere in the program, and
how many pass without any finding.
"""

import argparse
import random
from collections import Counter
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
from cam_programs import Sound, decoded_text, sound_program
from mutants import Mutant, mutant

from parser.geometry.curves import Floats
from parser.shape.contours import CLOSED_WITHIN_UM
from parser.toolpath import Toolpath
from sim.check.file_check import Job, check_file
from sim.check.result import CheckResult
from sim.check.settings import CheckSettings

_OF_CONTOURS = ("3B301", "3B302")  # they stand at the contour's last block and mean all of it
_SAMPLES = np.linspace(0.0, 1.0, 9)[1:]


class Trial(NamedTuple):
    """A mutant with what was found: ``block``, ``contour`` or ``missed``; ``still`` where its path did not move."""

    mutant: Mutant
    printed: bool
    caught: str
    is_error: bool
    text: str


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--mutants", type=int, default=4000)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--missed", metavar="KIND", help="print the mutants of this kind that were missed")
    asked = options.parse_args()
    rng = random.Random(asked.seed)
    done = list(trials(rng, (sound_program(rng, printed=at % 2 == 1) for at in range(asked.mutants))))
    for printed in (False, True):
        print("with printed ends" if printed else "without printed ends")
        print(f"{'fault':24}{'mutants':>8}{'moved':>8}{'block':>8}{'contour':>9}{'missed':>8}{'error':>8}")
        for kind, n in sorted(tally(done, printed=printed).items()):
            moved = max(n["moved"], 1)
            shares = "".join(f"{n[key] / moved:{width}.1%}" for key, width in _COLUMNS)
            print(f"{kind:24}{n['mutants']:8}{n['moved']:8}{shares}")
    for trial in done:
        if trial.caught == "missed" and trial.mutant.kind == asked.missed:
            print(f"--- {trial.mutant.kind}, line {min(trial.mutant.lines)}\n{trial.text}")


_COLUMNS = (("block", 8), ("contour", 9), ("missed", 8), ("error", 8))


def trials(rng: random.Random, programs: Iterable[Sound], kind: str | None = None) -> Iterator[Trial]:
    """A mutant of each sound program that can be broken so; of one kind where it is given."""
    for sound in programs:
        made = mutant(rng, sound, kind)
        if made is not None:
            yield _tried(sound, made)


def tally(done: list[Trial], *, printed: bool) -> dict[str, Counter[str]]:
    """Counts by kind of fault, and over all."""
    counts: dict[str, Counter[str]] = {}
    for trial in done:
        if trial.printed != printed:
            continue
        for kind in (trial.mutant.kind, "~ all"):
            moved = trial.caught != "still"
            counts.setdefault(kind, Counter()).update(
                {"mutants": 1, "moved": moved, trial.caught: 1, "error": moved and trial.is_error}
            )
    return counts


def _tried(sound: Sound, made: Mutant) -> Trial:
    text = "\n".join(made.text) + "\n"
    result = check_file(Job("mutant.3b", text.encode(), CheckSettings()))
    moved = has_moved(decoded_text(sound.text), decoded_text(text))
    caught = _caught(result, made) if moved else "still"
    return Trial(made, sound.printed, caught, result.verdict == "fail", text)


def _caught(result: CheckResult, made: Mutant) -> str:
    if any(f.line in made.lines and f.code not in _OF_CONTOURS for f in result.findings):
        return "block"
    return "contour" if any(f.code != "3B102" for f in result.findings) else "missed"


def has_moved(sound: Toolpath, broken: Toolpath) -> bool:
    """Whether any place of the path, eight a block, lies more than 5 µm elsewhere, or is cut and was not."""
    if len(sound) != len(broken):
        return True
    if (sound.is_jump != broken.is_jump).any():
        return True
    off = _places(sound) - _places(broken)
    return bool((np.hypot(off[..., 0], off[..., 1]) > CLOSED_WITHIN_UM).any())


def _places(toolpath: Toolpath) -> Floats:
    """(n, 8, 2) places along the blocks."""
    share = _SAMPLES[None, :]
    start, end = toolpath.start_um[:, None, :], toolpath.end_um[:, None, :]
    line = start + share[..., None] * (end - start)
    angle = toolpath.start_angle_rad[:, None] + share * toolpath.sweep_rad[:, None]
    radius = toolpath.radius_um[:, None]
    arc = toolpath.center_um[:, None, :] + np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)
    return np.where(toolpath.is_arc[:, None, None], arc, line)


if __name__ == "__main__":
    main()
