"""Who is told how far the work has come."""

from typing import Protocol


class Progress(Protocol):
    """Told how far a stage has come; the stage by its name, of which people read the text in ``progress.toml``."""

    def __call__(self, stage: str, done: int, total: int) -> None:
        """`done` of `total` units of the stage."""


def silent(stage: str, done: int, total: int) -> None:
    """Progress that nobody watches."""
