"""What a text says to the card itself, outside of motion programs: variables, their definitions, the program begun."""

import re

from parser.pmac.expressions import Worked
from parser.pmac.values import UnknownValue, Values

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
