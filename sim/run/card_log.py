"""The log of a run's card as a file, whole or not at all."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from controller.card.core.settings import CardSettings
from controller.card.log import CardLog
from sim.base.files import staged


@contextmanager
def logging_to(path: Path | None, settings: CardSettings) -> Iterator[CardLog | None]:
    """Log that becomes the file `path`, a link followed, at the end of a block that raised nothing; none without.

    FileUnreadableError where the file cannot be written.
    """
    if path is None:
        yield None
        return
    target = path.resolve()
    with (
        staged(target.parent, [target.name]) as stage,
        (stage / target.name).open("w", encoding="utf-8", newline="\n") as stream,
    ):
        yield CardLog(stream, settings)
