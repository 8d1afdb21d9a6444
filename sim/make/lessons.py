"""A lesson made ready: what each exercise asks, and how it is marked, worked out of the files that it names.

What a program of a lesson is to cut: ways of the wire round its drawing, right ones and wrong ones.
"""

import re
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from parser.drawing.read import read_drawing
from parser.findings.errors import ProgramError, SettingsError
from parser.geometry.curves import Curves
from parser.program import Program, moving, parse_program, read_program
from sim.base.progress import silent
from sim.check.settings import CheckSettings
from sim.make.cam.model import CannotCutError, Figure
from sim.make.cam.offset_path import offset_path
from sim.make.cam.parts import parts_of
from sim.run.running import dry_run
from sim.setup.making import Corners, Making
from sim.setup.scenario import load_scenario
from sim.teach.drills import Drill, DrillRequest, drills_of
from sim.teach.lesson import BlockExercise, Direction, Exercise, FaultExercise, Lesson, PredictExercise, ProgramExercise
from sim.teach.plain.answers import Question
from sim.teach.plain.curves import Point
from sim.teach.plain.program import Target, Variant
from sim.teach.plain.rules import FaultRule, Rules
from sim.teach.programs import plain_curves

_MARKS = {"pause": "D", "end": "DD"}
_NO_TARGET = Target(Point(0.0, 0.0), 0, 0.0, [])
_NO_QUESTION = Question([], 0.0)
_TIME_WITHIN = 0.05

_TURNS: dict[Direction, int] = {"any": 0, "clockwise": -1, "counter-clockwise": 1}
_CORNERS: tuple[Corners, ...] = ("sharp", "round")


class ReadyExercise(NamedTuple):
    """An exercise, how it is marked, and what its page shows: the program that it is of, and faults in that."""

    exercise: Exercise
    rules: Rules
    program: Program | None = None
    drills: tuple[Drill, ...] = ()


class ReadyLesson(NamedTuple):
    """A lesson with all that its page and its marks need."""

    lesson: Lesson
    exercises: tuple[ReadyExercise, ...]


def ready_lesson(lesson: Lesson, path: Path) -> ReadyLesson:
    """A lesson of a file, made ready.

    DrycutError where a file that it names cannot be read, or does not go with its exercise.
    """
    exercises = (
        _ready(exercise, f"{path}: [[exercise]] {number}") for number, exercise in enumerate(lesson.exercises, 1)
    )
    return ReadyLesson(lesson, tuple(exercises))


def _ready(exercise: Exercise, where: str) -> ReadyExercise:
    match exercise:
        case BlockExercise():
            return ReadyExercise(exercise, _rules("block", shapes=exercise.shapes, tasks=exercise.tasks))
        case ProgramExercise():
            target, weights = target_of(exercise, where), list(exercise.weights)
            return ReadyExercise(exercise, _rules("program")._replace(target=target, weights=weights))
        case FaultExercise():
            return _with_faults(exercise, where)
        case PredictExercise():
            return _with_question(exercise, where)


def _rules(kind: str, *, ask: str = "", shapes: tuple[str, ...] = (), tasks: int = 1) -> Rules:
    return Rules(kind, ask, list(shapes), tasks, _NO_TARGET, [], [], _NO_QUESTION)


def _with_faults(exercise: FaultExercise, where: str) -> ReadyExercise:
    sound = _sound(exercise.program, where)
    bare = parse_program(without_remarks(sound), sound.name, sound.encoding, sound.choices)
    request = DrillRequest(exercise.number, exercise.tasks, exercise.level)
    try:
        drills = drills_of(bare, CheckSettings.reading(sound.choices), request)
    except SettingsError as error:
        raise SettingsError("lesson-no-drills", where=where, message=error.message) from None
    faults = [FaultRule(list(drill.lines), drill.group) for drill in drills]
    return ReadyExercise(exercise, _rules("fault", tasks=len(drills))._replace(faults=faults), bare, drills)


def _sound(path: Path, where: str) -> Program:
    """A program that an exercise names. SettingsError where it is none, FileUnreadableError where it is not there."""
    try:
        return moving(read_program(path))
    except ProgramError as error:
        raise SettingsError("lesson-file", where=where, file=path.name, message=error.message) from None


def without_remarks(program: Program) -> str:
    """The text of a program without what gives a fault away: remarks, headers and, in 3B, printed ends."""
    path = program.toolpath
    if path.words is None:
        return re.sub(r"\([^()\r\n]*\)", "", program.text)
    lines = [_MARKS[stop.kind] for stop in path.stops if stop.after == 0]
    for row, (first, past) in enumerate(path.source.span.tolist(), start=1):
        label = path.source.label[row - 1]
        lines.append((f"{label}: " if label else "") + program.text[first:past])
        lines += [_MARKS[stop.kind] for stop in path.stops if stop.after == row]
    return "\n".join(lines) + "\n"


def _with_question(exercise: PredictExercise, where: str) -> ReadyExercise:
    rules = _rules("predict", ask=exercise.ask, shapes=exercise.shapes, tasks=exercise.tasks)
    if exercise.program is None:
        return ReadyExercise(exercise, rules)
    program = _sound(exercise.program, where)
    if exercise.ask == "time":
        minutes = float(program.toolpath.length_um.sum()) / 1000.0 / exercise.feed_mm_min
        question = Question([minutes], _TIME_WITHIN * minutes)
    else:
        question = Question([float(_falls_in(exercise.program, program, where))], 0.0)
    return ReadyExercise(exercise, rules._replace(question=question), program)


def _falls_in(path: Path, program: Program, where: str) -> int:
    """The block, from 1, in which a run first frees a piece; 0 where none comes free."""
    remains = dry_run(program, replace(load_scenario(path), kerf=True), silent, measured=False).remains
    if remains is None:
        raise SettingsError("lesson-no-kerf", where=where, file=path.name)
    return min((piece.freed.block for piece in remains.pieces.freed), default=0)


def target_of(exercise: ProgramExercise, where: str) -> Target:
    """What an exercise is to cut; the drawing itself is its variant ``no-offset``.

    FileUnreadableError or DrawingError where the drawing cannot be read; SettingsError where it has not one contour,
    or the wire does not fit in.
    """
    figure = _figure(exercise, where)
    right = _ways("right", figure, exercise.offset_um)
    if not right:
        raise SettingsError("lesson-no-path", where=where, file=exercise.drawing.name)
    wrong = _ways("wrong-side", figure._replace(runs_inside=not figure.runs_inside), exercise.offset_um)
    ways = [*right, ("no-offset", figure.contour), *wrong] if exercise.offset_um > 0.0 else right[:1]
    return Target(
        thread=Point(*exercise.thread_um),
        turn=_TURNS[exercise.direction],
        within_um=exercise.within_um,
        variants=[Variant(name, plain_curves(way)) for name, way in ways],
    )


def _figure(exercise: ProgramExercise, where: str) -> Figure:
    figures = parts_of(read_drawing(exercise.drawing), Making()).figures
    if len(figures) != 1:
        raise SettingsError("lesson-drawing", where=where, file=exercise.drawing.name, count=len(figures))
    return figures[0]._replace(runs_inside=exercise.is_inside)


def _ways(name: str, figure: Figure, offset_um: float) -> list[tuple[str, Curves]]:
    """Ways at an offset with sharp and with round corners, those that the wire can take."""
    ways: list[tuple[str, Curves]] = []
    for corners in _CORNERS:
        with suppress(CannotCutError):
            ways.append((name, offset_path(figure, offset_um, corners)))
    return ways
