"""The page of a marked class, what is wrong most often first, and a page for each pupil. They need no script.

Whatever a hand-in says stands escaped.
"""

from pathlib import Path
from typing import Any, Final, Literal, NamedTuple

from parser.findings.catalogue import Bilingual
from parser.text.encoding import printable
from sim.show.html.environment import rendered
from sim.show.texts import bilingual
from sim.teach.marking import ClassResult, PupilMark, Slip
from sim.teach.plain.answers import WAYS, end_question, shape_at, step_question
from sim.teach.plain.rules import Rules
from sim.teach.plain.tasks import Task, seed_of_task, task_of

_ASSETS: Final = Path(__file__).with_name("assets")
_SENSES: Final = {0: "L", 1: "NR", -1: "SR"}
_MOST_LINES: Final = 60
"""Of an answer, on the page of a pupil."""


class RoomDoor(NamedTuple):
    """How pupils come to a lesson that is served: addresses in the network, none where it is not, and the code."""

    addresses: tuple[str, ...]
    code: str


def entry_page(title: Bilingual, why: Literal["", "wrong-code", "too-many"] = "") -> str:
    """Where pupils enter the code of a lesson that is served, and why the last one led nowhere. It needs no script."""
    return rendered(_ASSETS, "entry.html.j2", title=title, why=bilingual(f"class.{why}") if why else None)


def class_page(result: ClassResult, files: tuple[str, ...], door: RoomDoor | None = None) -> str:
    """``index.html``; `files` are the names of the pages of the pupils.

    Where the lesson is served, `door` is how pupils come to it, and the page looks for new hand-ins.
    """
    rows = [
        {"mark": mark, "file": file, "flags": flags_of(mark), "minutes": sum(mark.seconds) / 60.0}
        for mark, file in zip(result.marks, files, strict=True)
    ]
    pairs = [(result.marks[pair.this], result.marks[pair.other], pair.answers) for pair in result.alike]
    return rendered(
        _ASSETS,
        "class.html.j2",
        result=result,
        rows=rows,
        common=[(slip.exercise, slip_text(result, slip), count) for slip, count in result.common],
        pairs=pairs,
        number=points_text,
        door=door,
    )


def pupil_page(result: ClassResult, number: int, back: str = "index.html") -> str:
    """The page of a pupil, by his number from 0: answers, what they earned, what is right.

    `back` leads to the page of the class.
    """
    hand_in, mark = result.hand_ins[number], result.marks[number]
    exercises = [
        {
            "title": result.exercises[at],
            "points": result.points[at],
            "earned": mark.points[at],
            "tasks": _tasks(rules, seed_of_task(mark.seed, at), hand_in.answers[at], mark.shares[at]),
            "slips": [slip_text(result, slip) for slip in dict.fromkeys(mark.slips) if slip.exercise == at],
        }
        for at, rules in enumerate(result.rules)
    ]
    return rendered(
        _ASSETS,
        "pupil.html.j2",
        result=result,
        mark=mark,
        flags=flags_of(mark),
        exercises=exercises,
        number=points_text,
        back=back,
    )


def points_text(points: float) -> str:
    """Points as people write them, to a tenth."""
    return f"{round(points, 1):g}"


def flags_of(mark: PupilMark) -> list[Bilingual]:
    """What is to be known of a hand-in beside its marks."""
    flags = [("class.changed", mark.is_changed), ("class.of-other", mark.is_of_other)]
    return [bilingual(key) for key, is_there in flags if is_there]


def slip_text(result: ClassResult, slip: Slip) -> Bilingual:
    """A slip in words."""
    match result.rules[slip.exercise].kind:
        case "block":
            return bilingual(f"class.word-{slip.what}")
        case "program":
            return bilingual(f"lesson.part-{slip.what}")
        case "fault":
            return bilingual(f"drill.group-{slip.what}")
    return bilingual(f"class.ask-{slip.what}")


def _tasks(
    rules: Rules, seed: int, answers: tuple[tuple[str, ...], ...], shares: tuple[float, ...]
) -> list[dict[str, Any]]:
    return [
        {
            "ask": _question(rules, seed, task),
            "attempts": [_lines(text) for text in attempts],
            "percent": round(100.0 * share),
            "right": _right(rules, seed, task),
        }
        for task, (attempts, share) in enumerate(zip(answers, shares, strict=True))
    ]


def _lines(text: str) -> str:
    """An answer of several lines, without control characters, and not endlessly long."""
    lines = [printable(line)[:200] for line in text.splitlines()]
    return "\n".join(lines[:_MOST_LINES] + ["…"] * (len(lines) > _MOST_LINES))


def _question(rules: Rules, seed: int, task: int) -> str:
    """What a task asks for, in the words that both languages have: places in mm, or a block."""
    if not _is_of_seed(rules):
        return ""
    own = _task(rules, seed, task)
    if rules.kind == "predict":
        return written(own)
    sense = _SENSES[own.block.turn]
    centre = f" ⊙ {_place(*own.centre)}" if own.block.turn else ""
    return f"{sense} {_place(*own.start)} → {_place(*own.end)}{centre}"


def _right(rules: Rules, seed: int, task: int) -> str:
    """The right answer; empty where there is more than one."""
    if rules.kind == "program":
        return ""
    if rules.kind == "fault":
        rule = rules.faults[task]
        return f"{' / '.join(map(str, rule.lines))} {rule.group}"
    if not _is_of_seed(rules):
        return " ".join(points_text(value) for value in rules.question.right)
    own = _task(rules, seed, task)
    if rules.kind == "block":
        return written(own)
    if rules.ask == "end":
        return ", ".join(f"{value:g}" for value in end_question(own).right)
    return WAYS[step_question(shape_at(rules.shapes, task), seed_of_task(seed, task)).right]


def _is_of_seed(rules: Rules) -> bool:
    return rules.kind == "block" or rules.ask in {"end", "next-step"}


def _task(rules: Rules, seed: int, task: int) -> Task:
    return task_of(shape_at(rules.shapes, task), seed_of_task(seed, task))


def written(task: Task) -> str:
    """The block of a task as it is written."""
    block = task.block
    return f"B{block.x} B{block.y} B{block.count_um} G{'XY'[block.axis]} {_SENSES[block.turn]}{block.quadrant}"


def _place(x_um: float, y_um: float) -> str:
    return f"({x_um / 1000.0:g}, {y_um / 1000.0:g})"
