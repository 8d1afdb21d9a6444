"""How many single-block damages pass in silence: ``PYTHONPATH=. python tests/tools/single_damages.py --programs 200``.

Every block of sound programs without printed ends is lost, doubled or swapped with the one behind it, one at a time. A
damage counts where the decoded path moves (`mutation.has_moved`). Sound programs are those of the generators
(`cam_programs`, `sound`) and of the corpus.
"""

import argparse
import random
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import cam_programs
import sound
from mutation import has_moved

from parser.findings.codes import Severity
from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings

KINDS = ("lost", "doubled", "swapped")
CORPUS = Path(__file__).parents[1] / "corpus" / "real"
_BLOCK = re.compile(r"^(.*G[XY]\s*(?:L|NR|SR)\d).*$")


class Damage(NamedTuple):
    """A damaged text, how it was made, the block, from 0, and what the check says of it."""

    kind: str
    style: str
    at: int
    text: str
    codes: tuple[str, ...]
    worst: Severity | None


def unprinted(text: str) -> str:
    """A program without the ends and the header that a CAM prints: blocks and marks alone."""
    lines = []
    for line in text.splitlines():
        block = _BLOCK.match(line)
        if block:
            lines.append(re.sub(r"^[N\s]*\d*\s*:\s*", "", block[1]))
        elif re.fullmatch(r"(?:N?\s*\d+\s*:)?\s*DD?\s*(?://.*)?", line):
            lines.append("DD" if "DD" in line else "D")
    return "\n".join(lines) + "\n"


def programs(number: int, seed: int) -> Iterator[tuple[str, str]]:
    """Names of styles and texts of sound programs."""
    rng = random.Random(seed)
    for path in sorted(CORPUS.glob("*.3b")):
        yield "corpus", unprinted(path.read_text("utf-8", "replace"))
    for at in range(number):
        if at % 2:
            yield "cam", cam_programs.sound_program(rng, printed=False).text
        else:
            made = sound.sound_program(rng)
            if " nodes" not in made.name:
                yield made.name.split()[-1] if "+" not in made.name else "several", unprinted(made.data.decode())


def damages(text: str) -> Iterator[tuple[str, int, str]]:
    """Kinds, blocks and texts of all single-block damages."""
    lines = text.splitlines()
    blocks = [at for at, line in enumerate(lines) if _BLOCK.match(line)]
    for number, at in enumerate(blocks if len(blocks) > 1 else []):
        yield "lost", number, "\n".join([*lines[:at], *lines[at + 1 :], ""])
        yield "doubled", number, "\n".join([*lines[: at + 1], *lines[at:], ""])
        if at + 1 in blocks and lines[at + 1] != lines[at]:
            yield "swapped", number, "\n".join([*lines[:at], lines[at + 1], lines[at], *lines[at + 2 :], ""])


def found(text: str) -> tuple[tuple[str, ...], Severity | None]:
    """Codes of the findings of a text, and the gravest severity."""
    findings = check_file(Job("part.3b", text.encode(), CheckSettings())).findings
    order = list(Severity)
    worst = min((finding.severity for finding in findings), key=order.index, default=None)
    return tuple(sorted({finding.code for finding in findings})), worst


def trials(number: int, seed: int) -> Iterator[Damage]:
    """Every damage that moves the path of every sound program that the check is silent on."""
    for style, text in programs(number, seed):
        if found(text)[0]:
            yield Damage("sound", style, 0, text, *found(text))
            continue
        was = cam_programs.decoded_text(text)
        for kind, at, made in damages(text):
            if has_moved(was, cam_programs.decoded_text(made)):
                yield Damage(kind, style, at, made, *found(made))


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--programs", type=int, default=200)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--show", type=int, default=0, help="silent ones to print")
    asked = options.parse_args()
    made: Counter[tuple[str, str]] = Counter()
    silent: Counter[tuple[str, str]] = Counter()
    shown = 0
    for damage in trials(asked.programs, asked.seed):
        if damage.kind == "sound":
            print(f"a sound program is accused: {damage.style} {damage.codes}\n{damage.text}")
            continue
        for style in (damage.style, "~ all"):
            made[damage.kind, style] += 1
            silent[damage.kind, style] += not damage.codes
        if not damage.codes and shown < asked.show:
            shown += 1
            print(f"--- {damage.kind} block {damage.at + 1} of {damage.style}\n{damage.text}")
    for key in sorted(made):
        print(f"{key[0]:9}{key[1]:12}{made[key]:7}{silent[key] / made[key]:8.1%} silent")


if __name__ == "__main__":
    main()
