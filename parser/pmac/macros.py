"""What a text says outside of motion programs: directives of the download, and commands to the card itself.

Directives of the download: names that ``#define`` gives a text, and lines that ``#ifdef`` leaves out.

The card never sees them: the program that sends the file to it works them out (Turbo PMAC User's Manual, "Communicating
with the host", on substitution macros). Macros with parameters and included files are not worked out.

What a text says to the card itself, outside of motion programs: variables, their definitions, the program begun.
"""

import re
from typing import NamedTuple

import numpy as np

from parser.geometry.curves import Ints
from parser.pmac.expressions import UnknownValue, Values, Worked
from parser.text.source import Span

_DIRECTIVE = re.compile(r"[ \t]*#[ \t]*(define|undef|include|ifdef|ifndef|else|endif)\b([^\r\n]*)", re.IGNORECASE)
_DEFINED = re.compile(r"[ \t]+([A-Za-z_]\w*)(\(?)(.*)")
_NAME = re.compile(r"[A-Za-z_]\w*")
_LINES = re.compile(r"[^\r\n]*(?:\r\n|\r|\n|$)")
_DEEPEST = 16  # names in the text of names
_LONGEST = 4096  # characters that a name may stand for
_UNKNOWN = "__"  # no word of the language: the name itself may look like one
_ROOM, _TIMES = 1_000_000, 4  # characters, and of the text, that its names may come to: a few may double one another


class Expanded(NamedTuple):
    """A text with its macros worked out.

    Attributes
    ----------
    text
        What is sent to the card; directives are blank.
    begins, pasts
        (n,) int64, where each of its characters stands in the text as written; all of a macro are the name's.
        None where the text has no directive.
    left
        Where directives stand that are not worked out.
    """

    text: str
    begins: Ints | None = None
    pasts: Ints | None = None
    left: tuple[Span, ...] = ()

    def span(self, first: int, past: int) -> Span:
        """Place in the text as written of the characters from `first` up to `past`."""
        if self.begins is None or self.pasts is None or first >= past:
            return (first, past)
        return (int(self.begins[first]), int(self.pasts[past - 1]))


def expanded(text: str) -> Expanded:
    """A text without remarks, its macros worked out."""
    if not any(_DIRECTIVE.match(line) for line in text.splitlines() if "#" in line):
        return Expanded(text)
    work = _Expansion(_ROOM + _TIMES * len(text))
    for line in _LINES.finditer(text):
        work.line(line[0], line.start())
    return Expanded("".join(work.text), np.concatenate(work.begins), np.concatenate(work.pasts), tuple(work.left))


class _Expansion:
    """What is known of a text up to a line."""

    def __init__(self, room: int) -> None:
        self.text: list[str] = []
        self.begins: list[Ints] = []
        self.pasts: list[Ints] = []
        self.left: list[Span] = []
        self.names: dict[str, str] = {}
        self.bodies: dict[str, str] = {}
        self.room = room
        self.conditions: list[bool] = []

    def line(self, line: str, at: int) -> None:
        directive = _DIRECTIVE.match(line)
        if directive:
            self._directive(directive, at)
        if directive or not all(self.conditions):
            length = len(line.rstrip("\r\n"))
            self._put(" " * length + line[length:], at)
            return
        first = 0
        for name in _NAME.finditer(line) if self.names else ():
            if name[0] in self.names:
                self._put(line[first : name.start()], at + first)
                self._put_macro(name[0], (at + name.start(), at + name.end()))
                first = name.end()
        self._put(line[first:], at + first)

    def _directive(self, directive: re.Match[str], at: int) -> None:
        word, rest = directive[1].lower(), directive[2]
        name = rest.strip()
        if word in {"ifdef", "ifndef"}:
            self.conditions.append((name in self.names) == (word == "ifdef"))
        elif word == "else" and self.conditions:
            self.conditions[-1] = not self.conditions[-1]
        elif word == "endif" and self.conditions:
            self.conditions.pop()
        elif not all(self.conditions):
            return
        elif word == "undef":
            self.names.pop(name, None)
            self.bodies.clear()
        elif word == "define" and (defined := _DEFINED.fullmatch(rest)) and not defined[2]:
            self.names[defined[1]] = defined[3].strip()
            self.bodies.clear()
        else:
            self.left.append((at + len(directive[0]) - len(directive[0].lstrip()), at + len(directive[0].rstrip())))

    def _body(self, name: str) -> str:
        """The text of a name, with that of the names in it; as it stands where they are one another's, or too long."""
        body = self.bodies.get(name)
        if body is not None:
            return body
        body = self.names[name]
        for _ in range(_DEEPEST):
            longer = _NAME.sub(lambda found: self.names.get(found[0], found[0]), body)
            if longer == body or len(longer) > _LONGEST:
                break
            body = longer
        self.bodies[name] = body
        return body

    def _put(self, text: str, at: int) -> None:
        self.text.append(text)
        self.begins.append(np.arange(at, at + len(text), dtype=np.int64))
        self.pasts.append(np.arange(at + 1, at + len(text) + 1, dtype=np.int64))

    def _put_macro(self, name: str, span: Span) -> None:
        body = self._body(name)
        self.room -= len(body)
        if self.room < 0:
            self.left.append(span)
            body = _UNKNOWN
        self.text.append(body)
        self.begins.append(np.full(len(body), span[0], dtype=np.int64))
        self.pasts.append(np.full(len(body), span[1], dtype=np.int64))


_PLAIN = re.compile(r"M(\d+)->\*")
_STARTED = re.compile(r"B(\d+)R")


class Online:
    """The card as the text leaves it, line by line.

    Attributes
    ----------
    started
        Number of the program that is started; None without one.
    """

    def __init__(self, values: Values) -> None:
        self._values = values
        self._system = ""
        self._systems: dict[str, str] = {}
        self._open = set[str]()
        self.started: int | None = None

    def command(self, name: str) -> None:
        """A command in capitals without blanks."""
        if name.startswith("&"):
            self._system = name
        elif plain := _PLAIN.match(name):
            self._values.define_plain(f"M{int(plain[1])}")
        elif started := _STARTED.fullmatch(name):
            self.started = int(started[1])

    def assign(self, name: str, worked: Worked | None, *, in_another: bool) -> None:
        """A variable that gets a value; `in_another` where a PLC gives it, which runs when it likes.

        A letter alone is a variable whose number is a sum: any of the letter may change.
        """
        if in_another or worked is None or len(name) == 1:
            self._open.add(name)
            return
        if name[0] == "Q" and self._systems.setdefault(name, self._system) != self._system:
            self._open.add(name)  # each coordinate system has Q variables of its own
        try:
            self._values.set(name, worked(self._values))
        except UnknownValue:
            self._values.forget(name)

    def at_start(self) -> Values:
        """The values when a program starts, without those that something else gives."""
        for name in self._open:
            if len(name) == 1:
                self._values.forget_all(name)
            else:
                self._values.forget(name)
        return self._values
