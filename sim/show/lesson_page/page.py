"""A lesson as one page: all tasks, what marks them, and the file that a pupil hands in."""

import hashlib
import json
from pathlib import Path
from typing import Any, Final

from parser.documents import SaidEntry
from parser.findings.catalogue import Bilingual
from parser.text.encoding import printable
from sim.make.lessons import ReadyExercise, ReadyLesson, without_remarks
from sim.show.drill_page.page import HEIGHT, WIDTH, view_of
from sim.show.html.environment import rendered
from sim.show.lesson_page.model import ExerciseEntry, LessonEntry
from sim.teach.kinds import groups_of
from sim.teach.lesson import PredictExercise, ProgramExercise
from sim.teach.plain.program import PARTS

_ASSETS: Final = Path(__file__).with_name("assets")
_DIGEST: Final = 16


def lesson_page(ready: ReadyLesson, *, hands_in: bool = False) -> str:
    """``lesson.html``: the same lesson gives the same bytes. Whatever its files say stands escaped.

    A page that `hands_in` sends what is handed in to the server that it came from; else it saves a file.
    """
    lesson = ready.lesson
    return rendered(
        _ASSETS,
        "lesson.html.j2",
        title=lesson.title,
        minutes=lesson.minutes,
        points=lesson.points,
        exercises=[_view(exercise) for exercise in ready.exercises],
        parts=PARTS,
        box=(WIDTH, HEIGHT),
        hands_in=hands_in,
        data=lesson_entry(ready),
    )


def lesson_entry(ready: ReadyLesson) -> LessonEntry:
    """What the page hands over to its script; its digest is of all that decides marks."""
    lesson = ready.lesson
    exercises = [_entry(exercise) for exercise in ready.exercises]
    decides = {"numbers": lesson.numbers, "seed": lesson.seed, "exercises": [_decides(entry) for entry in exercises]}
    text = json.dumps(decides, ensure_ascii=False, sort_keys=True)
    return {
        "lesson": hashlib.sha256(text.encode()).hexdigest()[:_DIGEST],
        "title": _in_both(lesson.title),
        "numbers": lesson.numbers,
        "seed": lesson.seed,
        "exercises": exercises,
    }


def _decides(entry: ExerciseEntry) -> dict[str, Any]:
    return {"points": entry["points"], "rules": entry["rules"], "program": entry["program"]}


def _entry(ready: ReadyExercise) -> ExerciseEntry:
    exercise = ready.exercise
    return {
        "title": _in_both(exercise.title),
        "points": exercise.points,
        "rules": plain(ready.rules),
        "program": printable_lines(without_remarks(ready.program))
        if isinstance(exercise, PredictExercise) and ready.program
        else "",
        "feed_mm_min": exercise.feed_mm_min if isinstance(exercise, PredictExercise) else 0.0,
        "offset_um": exercise.offset_um if isinstance(exercise, ProgramExercise) else 0.0,
        "is_inside": isinstance(exercise, ProgramExercise) and exercise.is_inside,
    }


def _program(ready: ReadyExercise) -> str:
    """The program that an exercise asks about, as its page shows it; empty where it asks about none."""
    if not isinstance(ready.exercise, PredictExercise) or ready.program is None:
        return ""
    return printable_lines(without_remarks(ready.program))


def printable_lines(text: str) -> str:
    """A text of several lines without other control characters."""
    return "\n".join(printable(line) for line in text.splitlines())


def plain(value: Any) -> Any:
    """Named tuples as objects, all the way down."""
    if isinstance(value, tuple) and hasattr(value, "_asdict"):
        return {name: plain(part) for name, part in value._asdict().items()}
    return [plain(part) for part in value] if isinstance(value, list | tuple) else value


def _in_both(text: Bilingual) -> SaidEntry:
    return {"en": text.en, "zh": text.zh}


def _view(ready: ReadyExercise) -> dict[str, Any]:
    """What the template shows of an exercise."""
    drills, sound = ready.drills, ready.program
    return {
        "title": ready.exercise.title,
        "points": ready.exercise.points,
        "kind": ready.rules.kind,
        "ask": ready.rules.ask,
        "tasks": ready.rules.tasks,
        "drills": [view_of(drill, sound) for drill in drills] if sound else [],
        "groups": groups_of(sound) if drills and sound else [],
    }
