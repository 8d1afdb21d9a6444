"""Lessons: a file of exercises, and what each of them asks, as a teacher wrote it.

Four kinds of exercise: write a block, write the program of a drawing, find the fault, and say what it does.
"""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Final, Literal, NamedTuple, get_args

from parser.findings.catalogue import Bilingual
from parser.findings.errors import SettingsError
from parser.text.encoding import printable
from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import AS_IS, MM_AS_UM, FileName, Name, Number, OneOf, Places, Text, ValueKind, Whole
from sim.setup.toml.reader import Bound, load_toml, refuse_unknown, section, tables
from sim.teach.drills import LEVELS, MOST_SETS, Level
from sim.teach.plain.program import PARTS
from sim.teach.plain.tasks import SHAPES

ExerciseKind = Literal["block", "program", "fault", "predict"]
Numbers = Literal["own", "same"]
"""Whether each pupil gets numbers of his own, or all the same."""
Direction = Literal["any", "clockwise", "counter-clockwise"]
Asked = Literal["end", "next-step", "falls", "time"]
"""Of a block where it ends, or which step comes next; of a program when a piece falls, or how long it takes."""
LEVEL_NAMES: Final[Mapping[str, Level]] = dict(zip(("easy", "medium", "hard"), LEVELS, strict=True))
MOST_EXERCISES: Final = 40
_OF_A_SEED: Final[tuple[Asked, ...]] = ("end", "next-step")
_SEED = Bound(1, MOST_SETS)
_POINTS = Bound(0.5, 1000)
_PLACE_MM = Bound(-1e4, 1e4)


class BlockExercise(NamedTuple):
    """Write blocks: of which shapes, in turn, and how many tasks."""

    title: Bilingual
    points: float
    shapes: tuple[str, ...]
    tasks: int
    kind: ExerciseKind = "block"


class ProgramExercise(NamedTuple):
    """Write the program of a drawing.

    Attributes
    ----------
    drawing
        Its file; it has one closed contour.
    is_inside
        Whether the wire runs within the contour.
    offset_um, within_um
        Distance of the wire's centre from the contour, and how far the path may lie off.
    thread_um
        Where the wire is threaded.
    direction
        Which way round.
    weights
        Of `sim.teach.plain.program.PARTS`, each from 0.
    """

    title: Bilingual
    points: float
    drawing: Path
    is_inside: bool
    offset_um: float
    thread_um: tuple[float, float]
    direction: Direction
    within_um: float
    weights: tuple[float, ...]
    kind: ExerciseKind = "program"


class FaultExercise(NamedTuple):
    """Find the fault: in drills of a sound program, their set, how many, and of which level, None for all."""

    title: Bilingual
    points: float
    program: Path
    number: int
    tasks: int
    level: Level | None
    kind: ExerciseKind = "fault"


class PredictExercise(NamedTuple):
    """Say what it does: of blocks of some shapes, or of a program, None where it is of blocks, and its feed."""

    title: Bilingual
    points: float
    ask: Asked
    shapes: tuple[str, ...]
    tasks: int
    program: Path | None
    feed_mm_min: float
    kind: ExerciseKind = "predict"


Exercise = BlockExercise | ProgramExercise | FaultExercise | PredictExercise


class Lesson(NamedTuple):
    """A lesson as its file has it.

    Attributes
    ----------
    title, notes
        In both languages; notes are the teacher's.
    minutes
        How long it takes.
    numbers, seed
        Whether pupils have numbers of their own, and the seed of these.
    exercises
        In their order.
    """

    title: Bilingual
    notes: Bilingual
    minutes: int
    numbers: Numbers
    seed: int
    exercises: tuple[Exercise, ...]

    @property
    def points(self) -> float:
        """Of all exercises."""
        return sum(exercise.points for exercise in self.exercises)


class _Words(ValueKind):
    """A list of some words of a few, at least one."""

    name = "words"

    def __init__(self, words: tuple[str, ...]) -> None:
        self._words = words

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> tuple[str, ...]:
        """The words."""
        value = table.get(key)
        if not isinstance(value, list) or not value or not all(isinstance(word, str) for word in value):
            raise SettingsError("no-list-of-texts", where=where, key=key, found=value)
        for word in value:
            if word not in self._words:
                raise SettingsError("key-not-one-of", where=where, key=key, words=", ".join(self._words), found=word)
        return tuple(value)

    def schema(self) -> dict[str, Any]:
        """Of a list."""
        return {"type": "array", "minItems": 1, "items": {"enum": list(self._words)}}


class _Lines(Text):
    """A text of several lines."""

    def inside(self, value: Any) -> str:
        """Without control characters but line ends."""
        return "\n".join(map(printable, value.splitlines()))


class _OnePlace(Places):
    """One place [x, y] in mm."""

    def checked(self, table: Mapping[str, Any], key: str, where: str) -> Any:
        """The place."""
        return super().checked({key: [table.get(key)]}, key, where)

    def inside(self, value: Any) -> Any:
        """In µm."""
        (place,) = super().inside(value)
        return place.x, place.y


_TITLE = (Key("title", Name()), Key("title_zh", Name(), default=None))
_KIND = Key("kind", OneOf(get_args(ExerciseKind)))
_SHAPES = Key("shapes", _Words(tuple(SHAPES)), default=("slope",))
_COUNT = Key("count", Whole(Bound(1, 50)), default=5)
_ANY_POINTS = Key("points", Number(_POINTS), default=10)
_PROGRAM = Key("program", FileName())
LESSON = Section(
    "lesson",
    (
        *_TITLE,
        Key("notes", _Lines(), default=""),
        Key("notes_zh", _Lines(), default=None),
        Key("minutes", Whole(Bound(1, 600)), default=45),
        Key("numbers", OneOf(get_args(Numbers)), default="own"),
        Key("seed", Whole(_SEED), default=1),
    ),
    form="top",
)
PART_WEIGHTS = Section("parts", tuple(Key(part, Number(Bound(0, 100)), default=1) for part in PARTS))
_OF_KIND: Final[dict[str, tuple[Key, ...]]] = {
    "block": (_SHAPES, _COUNT),
    "program": (
        Key("drawing", FileName()),
        Key("side", OneOf(("inside", "outside"))),
        Key("offset_mm", Number(Bound(0, 5), "mm", MM_AS_UM), field="offset_um"),
        Key("thread_mm", _OnePlace(_PLACE_MM), field="thread_um"),
        Key("direction", OneOf(get_args(Direction)), default="any"),
        Key("within_um", Number(Bound(1, 1000), "µm", AS_IS), default=5),
    ),
    "fault": (
        _PROGRAM,
        Key("set", Whole(_SEED), default=1),
        Key("count", Whole(Bound(1, 30)), default=3),
        Key("level", OneOf(tuple(LEVEL_NAMES)), default=None),
    ),
    "predict": (
        Key("ask", OneOf(get_args(Asked))),
        _SHAPES,
        _COUNT,
        Key("program", FileName(), default=None),
        Key("feed_mm_min", Number(Bound(0.01, 1000), "mm/min", AS_IS), default=3.0),
    ),
}


def load_lesson(path: Path) -> Lesson:
    """A lesson of a file; files that it names lie beside it.

    FileUnreadableError where it cannot be read, SettingsError that names file, exercise and key where it is wrong.
    """
    content, where = load_toml(path), str(path)
    head = LESSON.read(content, where, others=("exercise",))
    rows = tables(content, "exercise", where)
    if not 0 < len(rows) <= MOST_EXERCISES:
        raise SettingsError("lesson-exercises", where=where, most=MOST_EXERCISES)
    exercises = tuple(_exercise(row, f"{where}: [[exercise]] {at}", path.parent) for at, row in enumerate(rows, 1))
    return Lesson(
        title=_both(head, "title"),
        notes=_both(head, "notes"),
        minutes=head["minutes"],
        numbers=head["numbers"],
        seed=head["seed"],
        exercises=exercises,
    )


def _both(read: Mapping[str, Any], name: str) -> Bilingual:
    """A text in both languages; the English one stands where the Chinese is missing."""
    return Bilingual(read[name], read[f"{name}_zh"] or read[name])


def _exercise(row: Mapping[str, Any], where: str, folder: Path) -> Exercise:
    kind = _KIND.read(row, where)
    keys = Section("exercise", (*_TITLE, _KIND, _ANY_POINTS, *_OF_KIND[kind]))
    others = ("parts",) if kind == "program" else ()
    refuse_unknown(row, (*(key.name for key in keys.keys), *others), where)
    read = keys.read(row, where, others)
    return _MADE[kind](row, where, folder, read | {"title": _both(read, "title")})


def _block(_: Mapping[str, Any], __: str, ___: Path, read: Mapping[str, Any]) -> BlockExercise:
    return BlockExercise(read["title"], read["points"], read["shapes"], read["count"])


def _program(row: Mapping[str, Any], where: str, folder: Path, read: Mapping[str, Any]) -> ProgramExercise:
    weights = PART_WEIGHTS.read(section(row, "parts", where), f"{where}: parts")
    if not sum(weights.values()) > 0.0:
        raise SettingsError("lesson-no-weights", where=where)
    return ProgramExercise(
        title=read["title"],
        points=read["points"],
        drawing=folder / read["drawing"],
        is_inside=read["side"] == "inside",
        offset_um=read["offset_um"],
        thread_um=read["thread_um"],
        direction=read["direction"],
        within_um=read["within_um"],
        weights=tuple(weights[part] for part in PARTS),
    )


def _fault(_: Mapping[str, Any], __: str, folder: Path, read: Mapping[str, Any]) -> FaultExercise:
    level = None if read["level"] is None else LEVEL_NAMES[read["level"]]
    return FaultExercise(read["title"], read["points"], folder / read["program"], read["set"], read["count"], level)


def _predict(row: Mapping[str, Any], where: str, folder: Path, read: Mapping[str, Any]) -> PredictExercise:
    ask, program = read["ask"], read["program"]
    of_seed = ask in _OF_A_SEED
    wrong = next((name for name in (("program",) if of_seed else ("shapes", "count")) if name in row), None)
    if wrong:
        raise SettingsError("lesson-key-of-other", where=where, key=wrong, ask=ask)
    if not of_seed and program is None:
        raise SettingsError("key-missing", where=where, key="program")
    return PredictExercise(
        title=read["title"],
        points=read["points"],
        ask=ask,
        shapes=read["shapes"],
        tasks=read["count"] if of_seed else 1,
        program=None if program is None else folder / program,
        feed_mm_min=read["feed_mm_min"],
    )


_MADE: Final[dict[str, Callable[[Mapping[str, Any], str, Path, Mapping[str, Any]], Exercise]]] = {
    "block": _block,
    "program": _program,
    "fault": _fault,
    "predict": _predict,
}
