"""How the process of a job speaks to the server: it is asked in JSON on stdin, and tells lines of JSON on stdout."""

import json
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final

from parser.files.reading import read_stdin
from parser.findings.errors import DrycutError
from sim.base.progress import Progress
from sim.show.terminal.printer import write

Asked = dict[str, str]
"""What is asked of a job: texts by their names, of which the page says some."""
_STEPS: Final = 100
"""Of a stage, that are told."""


def do(jobs: Mapping[str, Callable[[Asked], dict[str, Any]]]) -> None:
    """Do the job that is asked for; the last line says what came of it."""
    asked = json.loads(read_stdin())
    try:
        _tell(done=jobs[asked["job"]](asked))
    except DrycutError as error:
        _tell(wrong=error.in_both()._asdict())


def telling(stages: Sequence[str]) -> Progress:
    """Tells of the progress through these stages, by the hundredth of each."""
    told = ("", -1)

    def progress(stage: str, done: int, total: int) -> None:
        nonlocal told
        now = stage, _STEPS * done // total if total else _STEPS
        if now != told:
            told = now
            at = stages.index(stage) if stage in stages else len(stages) - 1
            _tell(stage=stage, at=at, of=len(stages), share=now[1] / _STEPS)

    return progress


def _tell(**values: Any) -> None:
    write(f"{json.dumps(values)}\n", "json")
