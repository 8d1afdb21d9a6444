"""A set of drills of one program: faults of as many kinds and levels as there are, each of which does something.

What a fault does to the path, and what gives it away.
"""

from collections import Counter
from collections.abc import Iterator
from random import Random
from typing import Final, Literal, NamedTuple, get_args

import numpy as np

from parser.findings.codes import CODES, Check, Severity
from parser.findings.errors import ProgramError, SettingsError
from parser.findings.findings import Finding
from parser.geometry.along import places
from parser.geometry.curves import Floats, Ints
from parser.geometry.distance import distance_to_curves
from parser.program import Program, parse_program
from parser.shape.contours import CLOSED_WITHIN_UM
from parser.toolpath import Toolpath
from sim.check.file_check import check_program
from sim.check.result import CheckResult
from sim.check.settings import CheckSettings
from sim.teach.kinds import KINDS, Group, Slip, Sound

Level = Literal["words", "picture", "sums"]
"""What gives a fault away: the words of its block by themselves, the picture of the path, or sums alone."""
LEVELS: Final[tuple[Level, ...]] = get_args(Level)
SEEN_FROM: Final = 0.02
"""Share of the part's extent from which on people see in a picture that the path leaves it (assumed)."""
_OF_WORDS: Final = (Check.GRAMMAR, Check.ORDER, Check.BLOCKS)
_FRACTIONS: Final = np.linspace(0.0, 1.0, 17)


class Departure(NamedTuple):
    """How a path differs from the one without the fault.

    Attributes
    ----------
    most_um
        The furthest that a place of it lies from where it should.
    is_cut_otherwise
        Whether it cuts what was a jump, or jumps what was cut.
    """

    most_um: float
    is_cut_otherwise: bool

    @property
    def is_there(self) -> bool:
        """Whether it is more than a path may lie open."""
        return self.is_cut_otherwise or self.most_um > CLOSED_WITHIN_UM


def departure(sound: Toolpath, damaged: Toolpath) -> Departure:
    """How a damaged path differs from the sound one, at 17 places a block.

    Paths of as many blocks are held against each other block by block, others cut by cut, whichever is nearest.
    """
    if len(sound) == len(damaged):
        rows = np.arange(len(sound))
        off = _places(sound, rows) - _places(damaged, rows)
        return Departure(float(np.hypot(*off.T).max()), bool((sound.is_jump != damaged.is_jump).any()))
    most = max(_furthest(sound, damaged), _furthest(damaged, sound))
    return Departure(most, is_cut_otherwise=False)


def level_of(sound: Program, damaged: Program, lines: frozenset[int]) -> Level | None:
    """What gives a fault in these lines away; None where it does nothing."""
    told_findings = {_finding_key(sound, found) for found in sound.findings}
    new = [
        found for found in damaged.findings if _is_of_words(found) and _finding_key(damaged, found) not in told_findings
    ]
    at_place = [found for found in new if found.line in lines]
    if any(map(_stops_it, at_place)):
        return "words"
    by = departure(sound.toolpath, damaged.toolpath)
    if not by.is_there:
        return None
    if at_place:
        return "words"
    extent = float(np.ptp(np.concatenate([sound.toolpath.start_um, sound.toolpath.end_um]), axis=0).max())
    return "picture" if by.is_cut_otherwise or by.most_um >= SEEN_FROM * extent else "sums"


def _stops_it(found: Finding) -> bool:
    """Whether the machine cannot go on here, or not as the program says, wherever the path leads."""
    return found.severity is Severity.ERROR or CODES[found.code].check is Check.ORDER


def _finding_key(program: Program, found: Finding) -> tuple[str, str]:
    """A finding by its code and the text of its line, whatever the line's number."""
    return found.code, program.excerpt(found.line) if found.line else ""


def _is_of_words(found: Finding) -> bool:
    return CODES[found.code].check in _OF_WORDS


def _places(path: Toolpath, rows: Ints) -> Floats:
    """Places (n × 17, 2) along the blocks of the rows (n,), µm."""
    return places(path, np.repeat(rows, len(_FRACTIONS)), np.tile(_FRACTIONS, len(rows)))


def _furthest(path: Toolpath, other: Toolpath) -> float:
    """The furthest that the cuts of a path go from those of the other, µm; infinite where one of them cuts nothing."""
    cuts, others = np.flatnonzero(~path.is_jump), np.flatnonzero(~other.is_jump)
    if not len(cuts) or not len(others):
        return np.inf
    at = _places(path, cuts)
    nearest = np.full(len(at), np.inf)
    for row in others.tolist():  # at most as many as a drill may have blocks
        nearest = np.minimum(nearest, distance_to_curves(other, np.full(len(at), row), at[:, 0], at[:, 1])[0])
    return float(nearest.max())


MOST_BLOCKS: Final = 500
"""Blocks of a program that people can look through."""
MOST_SETS: Final = 9999
_TRIES: Final = 8  # for each drill that is wanted


class DrillRequest(NamedTuple):
    """Which drills are wanted.

    Attributes
    ----------
    number
        Of the set, from 1: the same program has the same drills under the same number.
    drills
        How many.
    level
        The level of all of them; None for all levels.
    """

    number: int = 1
    drills: int = 10
    level: Level | None = None


class Drill(NamedTuple):
    """A program with one fault.

    Attributes
    ----------
    kind, group, level
        What the fault is, in one word and as people are asked for it, and what gives it away.
    lines
        Lines of the damaged text, from 1, any of which is a right answer.
    was, stands
        Lines of the sound text that are no longer there, none where one was added; and those that stand there instead.
    program
        The damaged one.
    by
        How its path differs.
    findings
        What its check finds, and that of the sound one does not.
    """

    kind: str
    group: Group
    level: Level
    lines: tuple[int, ...]
    was: tuple[str, ...]
    stands: tuple[str, ...]
    program: Program
    by: Departure
    findings: tuple[Finding, ...]


def drills_of(program: Program, settings: CheckSettings, request: DrillRequest) -> tuple[Drill, ...]:
    """Drills of a sound program, from easy to hard; fewer than asked where there are no more.

    Each is proved: its text cannot be obeyed as it stands, or its path leaves the sound one by more than a path may lie
    open. Its findings are those of the check, lengths in µm. Raises SettingsError for a program that is too long, that
    has findings that fail it, or in which nothing can be damaged so.
    """
    _refuse_long(program)
    before = check_program(program, settings)
    _refuse_unsound(program, before)
    chance = Random(request.number)  # noqa: S311 - the same for all who are told the number
    found: list[_Fault] = []
    seen: set[str] = set()
    for fault in _faults(Sound(program), chance, request):
        if fault.slip.text not in seen and request.level in {None, fault.level}:
            seen.add(fault.slip.text)
            found.append(fault)
            if _is_enough(found, request):
                break
    if not found:
        raise SettingsError("nothing-to-damage", name=program.name)
    counter = Counter(_told_findings(program, before.findings))
    drills = [_drill(program, fault, settings, counter) for fault in _chosen(found, request.drills)]
    return tuple(sorted(drills, key=lambda drill: (LEVELS.index(drill.level), -drill.by.most_um)))


def _refuse_long(program: Program) -> None:
    blocks = max(program.reading.counts.run, len(program.toolpath))
    if blocks > MOST_BLOCKS:
        raise SettingsError("too-many-blocks-to-drill", name=program.name, blocks=blocks, most=MOST_BLOCKS)


def _refuse_unsound(program: Program, result: CheckResult) -> None:
    if result.verdict == "fail":
        codes = ", ".join(sorted({found.code for found in result.findings if found.severity is Severity.ERROR}))
        name = program.name
        raise SettingsError("drills-of-unsound", name=name, codes=codes)


def _is_enough(found: list["_Fault"], request: DrillRequest) -> bool:
    """Whether each level that is asked for has as many faults to choose from as there may be drills."""
    counts = Counter(fault.level for fault in found)
    return all(counts[level] >= request.drills for level in LEVELS if request.level in {None, level})


class _Fault(NamedTuple):
    kind: str
    level: Level
    slip: Slip
    program: Program


def _faults(sound: Sound, chance: Random, request: DrillRequest) -> Iterator[_Fault]:
    """Faults of all kinds in turn, those left out that do nothing, or after which nothing can be read."""
    for _ in range(_TRIES * max(1, request.drills // 8)):
        for kind in chance.sample(sorted(KINDS), len(KINDS)):
            slip = KINDS[kind].make(chance, sound)
            fault = slip and slip.text != sound.text and _proved(sound.program, kind, slip)
            if fault:
                yield fault


def _proved(sound: Program, kind: str, slip: Slip) -> _Fault | None:
    try:
        damaged = parse_program(slip.text, sound.name, sound.encoding, sound.choices)
    except ProgramError:
        return None
    if damaged.toolpath.is_jump.all():
        return None
    level = level_of(sound, damaged, slip.lines)
    return _Fault(kind, level, slip, damaged) if level else None


def _chosen(found: list[_Fault], count: int) -> Iterator[_Fault]:
    """Of as many levels, groups, kinds and places as there are, in the order of chance otherwise."""
    levels: Counter[str] = Counter()
    groups: Counter[str] = Counter()
    kinds: Counter[str] = Counter()
    places: Counter[int] = Counter()
    left = list(found)
    for _ in range(min(count, len(left))):
        best = min(
            left,
            key=lambda each: (
                levels[each.level],
                groups[KINDS[each.kind].group],
                kinds[each.kind],
                places[min(each.slip.lines)],
            ),
        )
        left.remove(best)
        levels[best.level] += 1
        groups[KINDS[best.kind].group] += 1
        kinds[best.kind] += 1
        places[min(best.slip.lines)] += 1
        yield best


def _drill(sound: Program, fault: _Fault, settings: CheckSettings, before: Counter[tuple[str, str]]) -> Drill:
    """A fault with what the check says of it."""
    result = check_program(fault.program, settings)
    damaged = before.copy()
    findings = []
    for found, key in zip(result.findings, _told_findings(fault.program, result.findings), strict=True):
        if damaged[key] <= 0:
            findings.append(found)
        damaged[key] -= 1
    listed = lines_of(fault.program)
    return Drill(
        fault.kind,
        KINDS[fault.kind].group,
        fault.level,
        tuple(sorted(line for line in fault.slip.lines if line <= len(listed))),
        *_differing(lines_of(sound), listed),
        fault.program,
        departure(sound.toolpath, fault.program.toolpath),
        tuple(findings),
    )


def _told_findings(program: Program, findings: tuple[Finding, ...]) -> list[tuple[str, str]]:
    return [(found.code, program.excerpt(found.line) if found.line else "") for found in findings]


def lines_of(program: Program) -> list[str]:
    """The lines of a program's text, without their ends."""
    last = program.lines.line(len(program.text))
    lines = [program.excerpt(line) for line in range(1, last + 1)]
    return lines if lines[-1] else lines[:-1]  # nothing stands behind the last line end


def _differing(sound: list[str], damaged: list[str]) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Lines of either text between the first and the last that differ."""
    before, after = list(sound), list(damaged)
    while before and after and before[0] == after[0]:
        del before[0], after[0]
    while before and after and before[-1] == after[-1]:
        del before[-1], after[-1]
    return tuple(before), tuple(after)
