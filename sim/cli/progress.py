"""Progress on stderr for work that takes longer than a second: a bar on a terminal, a line now and then elsewhere."""

import time
from types import TracebackType
from typing import Final, Self

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskID, TextColumn, TimeRemainingColumn

from sim.show.terminal.printer import coloured, moves_cursor, say
from sim.show.terminal.streams import outlet
from sim.show.terminal.wrap import width_of
from sim.show.words.words import Words

SAY: Final = Words("en")
_QUIET_S = 1.0
_BETWEEN_LINES_S = 5.0
_LINES = 25  # rich asks the environment where one of the two is not told


class StageProgress:
    """Progress of stages that ``progress.toml`` names; call it with stage, done and total."""

    def __init__(self) -> None:
        self._next_s = time.monotonic() + _QUIET_S
        self._bar: Progress | None = None
        self._tasks: dict[str, TaskID] = {}

    def __enter__(self) -> Self:
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        if self._bar is not None:
            self._bar.stop()

    def __call__(self, stage: str, done: int, total: int) -> None:
        """Show how far a stage has come."""
        if self._bar is not None:
            self._show(self._bar, stage, done, total)
        elif time.monotonic() >= self._next_s and done < total:
            if moves_cursor(outlet(err=True)):
                self._bar = _bar()
                self._show(self._bar, stage, done, total)
            else:
                say(f"drycut: {SAY(f'progress.{stage}')}, {done / total:.0%}", err=True)
                self._next_s = time.monotonic() + _BETWEEN_LINES_S

    def _show(self, bar: Progress, stage: str, done: int, total: int) -> None:
        if stage not in self._tasks:
            self._tasks[stage] = bar.add_task(SAY(f"progress.{stage}"), total=total)
        bar.update(self._tasks[stage], completed=done, total=total)


def _bar() -> Progress:
    # It draws over itself with escape sequences, past the printer, and holds words of ours alone.
    stream = outlet(err=True)
    console = Console(file=stream, width=width_of(stream), height=_LINES, no_color=not coloured(stream))
    bar = Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.percentage:>3.0f} %"),
        TimeRemainingColumn(),
        console=console,
        transient=True,
    )
    bar.start()
    return bar
