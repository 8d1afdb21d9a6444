"""Hand-ins as they come in: each is marked at once, and written into a folder under class and name."""

import re
from pathlib import Path
from typing import Final

from sim.base.files import staged
from sim.jobs.class_marks import class_result, marking_of
from sim.make.lessons import ReadyLesson
from sim.show.lesson_page.page import lesson_entry
from sim.teach.handins import SUFFIX, HandIn, read_hand_in
from sim.teach.marking import ClassResult, marked

MOST_FILES: Final = 1000
"""That a class hands in; more are refused."""
_NO_NAME: Final = re.compile(r'[\\/:*?"<>|.\s]+')


class HandIns:
    """What a class has handed in, in a folder.

    Attributes
    ----------
    folder
        Where the files stand, one for each name and class: of somebody who hands in again the last one.
    number
        How many came in so far, those that were handed in again too.

    OSError where the folder cannot be made.
    """

    def __init__(self, ready: ReadyLesson, folder: Path) -> None:
        folder.mkdir(parents=True, exist_ok=True)
        self.ready, self.folder, self.number = ready, folder, 0
        self._lesson = lesson_entry(ready)["lesson"]
        self._marking = marking_of(ready)
        self._tasks = tuple(rules.tasks for rules in self._marking.rules)
        self._known: set[str] = set()

    def take(self, data: bytes) -> tuple[HandIn, float] | None:
        """A hand-in and the points that it earns; None where there are too many. HandInError where it is none."""
        hand_in = read_hand_in(data, self._lesson, self._tasks)
        points = marked(self._marking, hand_in).sum
        name = file_name(hand_in)
        if name not in self._known and len(self._known) >= MOST_FILES:
            return None
        with staged(self.folder, [name]) as stage:
            (stage / name).write_bytes(data)
        self._known.add(name)
        self.number += 1
        return hand_in, points

    def result(self) -> ClassResult:
        """All that is in the folder, marked."""
        return class_result(self.ready, self.folder)


def file_name(hand_in: HandIn) -> str:
    """The name of a file for a class and a name, in letters that no system takes for a way elsewhere."""
    words = (_NO_NAME.sub(" ", text).strip() or "_" for text in (hand_in.group, hand_in.name))
    return " ".join(words) + SUFFIX
