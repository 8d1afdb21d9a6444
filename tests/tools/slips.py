"""How often one wrong word is named: ``PYTHONPATH=. python tests/tools/slips.py``.

Sound programs as a CAM writes them, with printed ends or without, are broken in one word at a time: each quadrant and
the other sense of each block, its other count axis, a digit of its X, Y and J. A slip counts where it moves the path
by more than 5 µm. The table says, for each kind of word: how often a finding names that word with what stood there and
none names another; how often it is one of several that findings offer; how often a finding names another word alone;
how often findings name no word, and how often there are none. Then how many findings at one block contradict each
other, and how many edits of ``--fix`` restore the path, and how many do not.
"""

import argparse
import random
from collections import Counter
from collections.abc import Callable, Iterator
from itertools import combinations
from typing import NamedTuple

from broken import with_digit
from cam_programs import Sound, decoded_text, sound_program
from mutation import has_moved
from plain import PlainBlock

from parser.findings.findings import Finding, edited
from sim.check.file_check import Job, check_file
from sim.check.result import CheckResult
from sim.check.settings import CheckSettings

Word = tuple[str, str]
"""A field and what it says: ``("sense", "SR3")``."""


class Slip(NamedTuple):
    """A program with one wrong word, at a line from 1; `was` is the word that stood there."""

    kind: str
    text: str
    line: int
    was: Word


class Told(NamedTuple):
    """What a check told of a slip: ``right``, ``choice``, ``wrong``, ``no word`` or ``silent``.

    `contradicts` tells that two hints at one block cannot both be followed; `mended` is None where nothing was edited,
    else whether the edits restored the path.
    """

    slip: Slip
    verdict: str
    contradicts: bool
    mended: bool | None
    result: CheckResult


def slips(rng: random.Random, sound: Sound) -> Iterator[Slip]:
    """One of each kind for each block, and all quadrants of it."""
    for at, row in enumerate(sound.rows):
        if row.block is None:
            continue
        for kind, changed, was in _changes(rng, row.block):
            if changed == row.block:
                continue
            rows = [*sound.rows[:at], row._replace(block=changed), *sound.rows[at + 1 :]]
            yield Slip(kind, "\n".join(one.text for one in rows) + "\n", at + 1, was)


def _changes(rng: random.Random, block: PlainBlock) -> Iterator[tuple[str, PlainBlock, Word]]:
    sense = ("sense", f"{block.sense}{block.quadrant}")
    for quadrant in (1, 2, 3, 4):
        yield "quadrant", block._replace(quadrant=quadrant), sense
    other = {"NR": "SR", "SR": "NR"}.get(block.sense)
    if other:
        yield "sense", block._replace(sense=other), sense
    yield "axis", block._replace(axis="XY"[block.axis == "X"]), ("axis", f"G{block.axis}")
    for field in ("x", "y", "count"):
        how = rng.choice(("changed", "lost", "doubled"))
        yield f"{field} digit", with_digit(rng, block, field, how), (field, str(getattr(block, field)))


def told(sound: Sound, slip: Slip) -> Told | None:
    """None where the slip moves nothing."""
    meant, written = decoded_text(sound.text), decoded_text(slip.text)
    if not has_moved(meant, written):
        return None
    result = check_file(Job("slip.3b", slip.text.encode(), CheckSettings()))
    named = [(finding.line, word) for finding in result.findings for word in words_named(finding)]
    is_right = [line == slip.line and _is_word(word, slip.was) for line, word in named]
    if not result.findings:
        verdict = "silent"
    elif not named:
        verdict = "no word"
    else:
        verdict = "right" if all(is_right) else "choice" if any(is_right) else "wrong"
    edits = [edit for finding in result.findings for edit in finding.edits]
    mended = not has_moved(meant, decoded_text(edited(slip.text, edits))) if edits else None
    return Told(slip, verdict, contradiction(result) != "", mended, result)


def contradiction(result: CheckResult) -> str:
    """Two findings at one block of which no word of one can be written as the other asks, as text; else empty."""
    named: dict[int, list[tuple[Finding, list[Word]]]] = {}
    for finding in result.findings:
        words = words_named(finding)
        if words:
            named.setdefault(finding.block, []).append((finding, words))
    for block, told in named.items():
        for (one, mine), (other, its) in combinations(told, 2):
            if not any(_is_word(word, its_word) for word in mine for its_word in its):
                return f"block {block}: {one.code} {mine}, {other.code} {its}"
    return ""


def words_named(finding: Finding) -> list[Word]:
    """The words that the hint of a finding tells to write."""
    of = {name: str(value) for name, value in finding.values.items()}
    named: dict[str, Callable[[], list[Word]]] = {
        "3B202": lambda: [("axis", f"G{of['other']}")],
        "3B203": lambda: [("sense", label) for label in (of["ruled"], *of["others"].split(" / ")) if label],
        "3B204": lambda: [("axis", f"G{of['ruled']}")],
        "3B211": lambda: [("sense", of["other"])],
        "3B217": lambda: [(of["field"].removeprefix("field-"), of["other"])],
        **dict.fromkeys(
            ("3B304", "3B322"),
            lambda: [
                (of["field"].removeprefix("field-"), of["other"]),
                *(_told_word(text) for text in of["others"].split(" / ") if text),
            ],
        ),
        "3B306": lambda: [("sense", of["word"])],
    }
    return named[finding.code]() if finding.code in named and not finding.is_uncertain else []


def _told_word(text: str) -> Word:
    """``J 4000``, ``GX`` or ``NR3`` as a word."""
    letter, _, number = text.partition(" ")
    if number:
        return {"X": "x", "Y": "y", "J": "count"}[letter], number
    return "axis" if text.startswith("G") else "sense", text


def _is_word(word: Word, was: Word) -> bool:
    """Whether a word named is that; the letters of a sense may stand alone, and numbers close to 2 µm."""
    if word[0] != was[0]:
        return False
    if word[1].isdigit() and was[1].isdigit():
        return abs(int(word[1]) - int(was[1])) <= 2
    return word[1] == was[1] or (word[1] in ("NR", "SR") and was[1].startswith(word[1]))


def measured(rng: random.Random, programs: int, *, printed: bool) -> Iterator[Told]:
    for _ in range(programs):
        sound = sound_program(rng, printed=printed)
        for slip in slips(rng, sound):
            one = told(sound, slip)
            if one is not None:
                yield one


VERDICTS = ("right", "choice", "wrong", "no word", "silent")


def main() -> None:
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--programs", type=int, default=200)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--show", metavar="VERDICT", help="print programs with this verdict")
    options.add_argument("--kind", help="of this kind alone")
    asked = options.parse_args()
    for printed in (True, False):
        counts: dict[str, Counter[str]] = {}
        for one in measured(random.Random(asked.seed), asked.programs, printed=printed):
            of = {one.verdict: 1, "moved": 1, "contradicts": one.contradicts}
            of |= {"mended" if one.mended else "spoilt": one.mended is not None}
            for kind in (one.slip.kind, "~ all"):
                counts.setdefault(kind, Counter()).update(of)
            if _is_asked(one, asked.show, asked.kind):
                _show(one)
        _print(counts, printed=printed)


def _is_asked(one: Told, verdict: str | None, kind: str | None) -> bool:
    is_verdict = {"contradicts": one.contradicts, "spoilt": one.mended is False}.get(
        verdict or "", one.verdict == verdict
    )
    return is_verdict and kind in (None, one.slip.kind)


def _show(one: Told) -> None:
    print(f"--- {one.slip.kind}, line {one.slip.line}, was {one.slip.was}; {contradiction(one.result)}")
    print(one.slip.text)
    for finding in one.result.findings:
        print(f"    {finding.line} {finding.code} {dict(finding.values)} {finding.edits}")


def _print(counts: dict[str, Counter[str]], *, printed: bool) -> None:
    print("with printed ends" if printed else "without printed ends")
    heads = (*VERDICTS, "contradicts", "mended", "spoilt")
    print(f"{'wrong word':14}{'moved':>8}" + "".join(f"{head:>12}" for head in heads))
    for kind, n in sorted(counts.items()):
        print(f"{kind:14}{n['moved']:8}" + "".join(f"{n[head] / n['moved']:12.2%}" for head in heads))


if __name__ == "__main__":
    main()
