"""Progress on stderr for work that takes longer than a second: a bar on a terminal, a line now and then elsewhere."""

import math
import threading
import time
from collections.abc import Mapping
from contextlib import suppress
from types import TracebackType
from typing import Final, Self

from rich.console import Console
from rich.progress import BarColumn, Progress, SpinnerColumn, TaskID, TextColumn

from sim.cli.spoken import words
from sim.show.terminal.printer import coloured, moves_cursor, say
from sim.show.terminal.streams import OutputError, outlet
from sim.show.terminal.wrap import width_of
from sim.show.texts.phrases import lasting

WEIGHTS: Final[Mapping[str, float]] = {"run": 4.0, "kerf": 4.0, "comparison": 3.0, "pieces": 3.0, "pictures": 3.0}
"""About how long stages take beside the others, which count 1: of a part of six blocks and of one of ten thousand."""
_QUIET_S = 1.0
_BETWEEN_LINES_S = 5.0
_BETWEEN_LOOKS_S = 0.25
_MOST_GUESSED = 0.9
_LEAST_SHARE = 0.05  # of the work, before which nothing is said of the time that is left
_LINES = 25  # rich asks the environment where one of the two is not told


class StageProgress:
    """Progress of stages that ``progress.toml`` names; call it with stage, done and total.

    `stages` are all that are to come, in their order; one that is not among them is taken for another at the end. The
    first sign comes a second after the start, whether or not a stage has told of itself since. While a stage tells
    nothing it is taken to go on at the pace of the work so far, through nine tenths of itself at most.
    """

    def __init__(self, *stages: str) -> None:
        self._stages = list(stages)
        self._stage, self._told_share, self._ends_share = "", 0.0, 0.0
        self._began_s = self._told_s = time.monotonic()
        self._ended = threading.Event()
        self._told = threading.Lock()
        self._shown: tuple[Progress, TaskID] | None = None
        self._teller = threading.Thread(target=self._tell, daemon=True)

    def __enter__(self) -> Self:
        self._teller.start()
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        self.finish()

    def finish(self) -> None:
        """Nothing more is to come: the bar goes."""
        self._ended.set()
        self._teller.join()
        if self._shown is not None:
            self._shown[0].stop()
            self._shown = None

    def __call__(self, stage: str, done: int, total: int) -> None:
        """Show how far a stage has come."""
        with self._told:
            if stage not in self._stages:
                self._stages.append(stage)
            self._stage, self._told_s = stage, time.monotonic()
            self._told_share = self._share_at(stage, done / total if total else 1.0)
            self._ends_share = self._share_at(stage, 1.0)
            if self._shown is not None:
                self._update(*self._shown)

    def _share_at(self, stage: str, of_stage: float) -> float:
        """How much of the whole is done when so much of a stage is."""
        weights = [WEIGHTS.get(name, 1.0) for name in self._stages]
        at = self._stages.index(stage)
        return (sum(weights[:at]) + weights[at] * of_stage) / sum(weights)

    def _share(self, now_s: float) -> float:
        """How much of the whole is likely to be done."""
        pace = self._told_share / max(self._told_s - self._began_s, 1e-3)
        most = self._told_share + _MOST_GUESSED * (self._ends_share - self._told_share)
        return min(self._told_share + pace * (now_s - self._told_s), most)

    def _tell(self) -> None:
        """Show a bar after a second, or say a line then and every few seconds; in a thread of its own."""
        wait_s = _QUIET_S
        while not self._ended.wait(wait_s):
            with self._told:
                if not self._stage:
                    continue
                if moves_cursor(outlet(err=True)):
                    self._shown = self._shown or _bar()
                    self._update(*self._shown)
                    wait_s = _BETWEEN_LOOKS_S
                else:
                    line, share = self._line()
                    with suppress(OutputError):  # the command itself meets it too, and tells it
                        say(words()("progress.line", line=line, share=f"{share:.0%}"), err=True)
                    wait_s = _BETWEEN_LINES_S

    def _update(self, bar: Progress, task: TaskID) -> None:
        line, share = self._line()
        bar.update(task, description=line, completed=share)

    def _line(self) -> tuple[str, float]:
        """The stage, which of how many it is, about how long the rest will take; and how much is done."""
        now_s = time.monotonic()
        share = self._share(now_s)
        at, text = self._stages.index(self._stage) + 1, words()(f"progress.{self._stage}")
        if len(self._stages) > 1:
            text = words()("progress.step", number=at, count=len(self._stages), stage=text)
        if share < _LEAST_SHARE:
            return text, share
        left_s = (now_s - self._began_s) * (1.0 / share - 1.0)
        left = lasting(left_s) if left_s >= 60.0 else f"{math.ceil(left_s)}{words()('phrases.seconds')}"
        return words()("progress.left", stage=text, left=left), share


def _bar() -> tuple[Progress, TaskID]:
    # It draws over itself with escape sequences, past the printer, and holds words of ours alone.
    stream = outlet(err=True)
    console = Console(file=stream, width=width_of(stream), height=_LINES, no_color=not coloured(stream))
    bar = Progress(
        SpinnerColumn(),
        TextColumn("{task.description}"),
        BarColumn(),
        TextColumn("{task.percentage:>3.0f} %"),
        console=console,
        transient=True,
    )
    bar.start()
    return bar, bar.add_task("", total=1.0)
