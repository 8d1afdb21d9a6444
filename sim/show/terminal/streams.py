"""Standard streams as a command may find them: closed, full, left by their reader, or in an encoding that lacks signs.

* Nobody listens: the stream is closed, or its reader has gone. What is written goes nowhere, and the command goes on:
  its exit code still tells the verdict.
* What is meant for someone cannot be written, such as on a full disk: of stdout that is an `OutputError`. Of stderr it
  is as if nobody listened: messages never change an exit code.
* A character that the encoding lacks is written in ASCII.
"""

import codecs
import errno
import io
import os
import sys
from typing import Final, Self, TextIO, cast

from parser.findings.errors import DrycutError, system_message
from parser.text.encoding import harmless

_PLAIN: Final = {"µ": "u", "×": "x", "–": "-", "−": "-", "·": "-", "…": "...", "≤": "<=", "≥": ">=", "²": "2"}
_STANDARD: Final = (0, 1, 2)
# Windows tells of a pipe whose reader has gone by EINVAL (bugs.python.org/issue35754).
_GONE: Final = {errno.EPIPE, errno.ESHUTDOWN, errno.ECONNRESET} | ({errno.EINVAL} if os.name == "nt" else set())


class OutputError(DrycutError, OSError):
    """What a command prints cannot be written to stdout, though there is someone to read it."""


class Outlet(io.TextIOBase):
    """A standard stream that outlives its reader; only what is harmless already is written to it.

    Parameters
    ----------
    stream
        The stream of the system.
    must_arrive
        Whether `OutputError` is raised where it cannot be written.
    """

    def __init__(self, stream: TextIO, *, must_arrive: bool) -> None:
        self._stream = stream
        self._must_arrive = must_arrive
        self._lost = False

    @property
    def encoding(self) -> str:  # type: ignore[override]  # read only
        """Encoding of the stream."""
        return self._stream.encoding or "utf-8"

    def isatty(self) -> bool:
        """Whether it is a terminal."""
        return not self._lost and self._stream.isatty()

    def fileno(self) -> int:
        """Number of the system's file. OSError where it has none."""
        return self._stream.fileno()

    def write(self, text: str | bytes) -> int:
        """Write a text, or bytes, unless nobody listens."""
        if not self._lost:
            try:
                _ = self._stream.write(text) if isinstance(text, str) else self._stream.buffer.write(text)
            except OSError as error:
                self._lose(error)
        return len(text)

    @property
    def buffer(self) -> Self:
        """Where bytes go: it takes them too, behind a `flush`."""
        return self

    def flush(self) -> None:
        """Hand over to the system what was written; nothing once the stream is closed, where Python flushes again."""
        if not self._lost and not self._stream.closed:
            try:
                self._stream.flush()
            except OSError as error:
                self._lose(error)

    def _lose(self, error: OSError) -> None:
        """From now on everything goes nowhere, also what Python still holds and writes at its end."""
        self._lost = True
        _to_nowhere(self._stream)
        if self._must_arrive and error.errno not in _GONE:
            raise OutputError("output-failed", why=system_message(error)) from None


class Cleaned(io.TextIOBase):
    """What stands in the place of stdout or stderr: whatever a library writes there is made harmless, line by line.

    Attributes
    ----------
    outlet
        Where the lines go.
    """

    def __init__(self, outlet: Outlet) -> None:
        self.outlet = outlet
        self._begun = ""

    @property
    def encoding(self) -> str:  # type: ignore[override]  # read only
        """Encoding of the stream."""
        return self.outlet.encoding

    @property
    def errors(self) -> str:  # type: ignore[override]  # read only
        """What is done about characters that the encoding lacks."""
        return "drycut.plain"

    def isatty(self) -> bool:
        """Whether it is a terminal."""
        return self.outlet.isatty()

    def fileno(self) -> int:
        """Number of the system's file. OSError where it has none."""
        return self.outlet.fileno()

    def write(self, text: str) -> int:
        """Write whole lines; the beginning of one waits for its end, or for `flush`. TypeError for bytes."""
        *lines, self._begun = f"{self._begun}{_text(text)}".split("\n")
        for line in lines:
            self.outlet.write(f"{harmless(line)}\n")
        return len(text)

    @property
    def buffer(self) -> "CleanedBytes":
        """Where bytes go, such as those of click for completion in a shell."""
        return CleanedBytes(self)

    def flush(self) -> None:
        """Hand over to the system what was written, also the beginning of a line."""
        begun, self._begun = self._begun, ""
        if begun:
            self.outlet.write(harmless(begun))
        self.outlet.flush()


class CleanedBytes(io.RawIOBase):
    """The bytes of `Cleaned`: UTF-8, made harmless as texts are, with line ends as they come."""

    def __init__(self, cleaned: Cleaned) -> None:
        self._cleaned = cleaned

    def writable(self) -> bool:
        """Yes."""
        return True

    def write(self, data: object) -> int:
        """Write bytes, behind what was written before."""
        text = bytes(memoryview(data)).decode("utf-8", "backslashreplace")  # type: ignore[arg-type]  # has bytes
        self._cleaned.flush()
        self._cleaned.outlet.write(_lines_and_columns(text).encode())
        return len(text.encode())

    def flush(self) -> None:
        """Hand over to the system what was written."""
        if not self.closed:
            self._cleaned.flush()


def prepare_streams() -> None:
    """Put streams in the place of stdout and stderr that nothing harmful passes, and that outlive their readers.

    A standard stream that is closed is opened on nothing: else the next file that is opened would get its number, and
    what a library prints would end in that file.
    """
    for number in _STANDARD:
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    codecs.register_error("drycut.plain", _plain)
    sys.stdout = Cleaned(Outlet(_spelling_out(sys.stdout), must_arrive=True))
    sys.stderr = Cleaned(Outlet(_spelling_out(sys.stderr), must_arrive=False))


def outlet(*, err: bool = False) -> TextIO:
    """Where lines go that are harmless already; what others began to write there goes first."""
    stream = sys.stderr if err else sys.stdout
    if isinstance(stream, Cleaned):
        stream.flush()
        return cast("TextIO", stream.outlet)
    return stream


def _spelling_out(stream: TextIO | None) -> TextIO:
    """A stream that spells out what its encoding lacks, such as µ in GBK; one on nothing where there is none."""
    if stream is None:
        return open(os.devnull, "w", encoding="utf-8")  # noqa: PTH123 - as long as the process
    if isinstance(stream, io.TextIOWrapper):
        stream.reconfigure(errors="drycut.plain")
    return stream


def _to_nowhere(stream: TextIO) -> None:
    try:
        number = stream.fileno()
    except OSError:
        return  # a stream of a test
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, number)
    os.close(nowhere)


def _lines_and_columns(text: str) -> str:
    """A text made harmless, in which lines and columns stay apart: shells read what completes a word so."""
    return "\n".join("\t".join(map(harmless, line.split("\t"))) for line in text.split("\n"))


def _text(text: object) -> str:
    if not isinstance(text, str):
        raise TypeError(f"a stream of text takes no {type(text).__name__}")
    return text


def _plain(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    lost = error.object[error.start : error.end]
    return "".join(_PLAIN.get(char, "?") for char in lost), error.end
