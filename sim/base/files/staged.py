"""Output files of a run: made aside and put in their folder as one set, or not at all."""

import stat
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path

from parser.findings.errors import FileUnreadableError
from parser.findings.messages import Message, system_message
from sim.base.files.locks import alone_in
from sim.base.files.stages import clear, close, stage_in
from sim.base.files.swap import swap


@contextmanager
def staged(target: Path, names: Sequence[str]) -> Iterator[Path]:
    """Empty folder whose files `names` are put in `target` at the end of a block that raised nothing.

    They come as one set: at every moment, and after a kill at any moment, the names in `target` show the files that
    were there before, or the new ones, never some of each (docs/report.md says how, and what Windows lacks). What the
    block did not make is not there afterwards either: no file of an earlier run stands beside those of this. Where the
    block raises, or one of the names cannot be replaced, all is as it was, and folders made for it are gone. What runs
    that were killed have left in `target` is cleared away. FileUnreadableError where the target is no folder or cannot
    be written.
    """
    try:
        made = _make_folders(target)
        with _removed_on_error(made), stage_in(target) as stage:
            with alone_in(target):
                clear(target)
            _refuse_other_than_files(target, names)
            yield stage
            with alone_in(target):
                clear(target)
                _refuse_other_than_files(target, names)
                try:
                    swap(stage, target, names)
                finally:
                    close(stage, target)
    except FileUnreadableError:
        raise
    except OSError as error:
        raise FileUnreadableError("cannot-be-written", file=_named(error, target), why=system_message(error)) from None


def _named(error: OSError, target: Path) -> Path:
    """The file of the target folder that an error is about, or that folder."""
    named = (Path(name) for name in (error.filename, error.filename2) if isinstance(name, str | Path))
    return next((path for path in named if path.parent == target), target)


def _refuse_other_than_files(target: Path, names: Sequence[str]) -> None:
    """FileUnreadableError where a folder, a device or a pipe has the name of a file that is to be written."""
    for path in (target / name for name in names):
        try:
            mode = path.stat().st_mode
        except OSError:  # nothing is there, or a link that leads nowhere
            continue
        if not stat.S_ISREG(mode):
            kind = Message("a-folder" if stat.S_ISDIR(mode) else "no-plain-file")
            raise FileUnreadableError("is-no-file-to-replace", path=path, kind=kind)


def _make_folders(target: Path) -> list[Path]:
    """Make a folder with its parents; those that were missing, innermost first."""
    if target.exists() and not target.is_dir():
        raise FileUnreadableError("is-a-file-not-a-folder", path=target)
    missing = [folder for folder in (target, *target.parents) if not folder.exists()]
    with _removed_on_error(missing):
        target.mkdir(parents=True, exist_ok=True)
    return missing


@contextmanager
def _removed_on_error(folders: list[Path]) -> Iterator[None]:
    try:
        yield
    except BaseException:
        for folder in folders:
            with suppress(OSError):
                folder.rmdir()
        raise
