"""What is told of a program besides its text, whatever the dialect: marks, family, unit and offset registers."""

import re
from collections.abc import Iterable
from typing import NamedTuple


class Marks(NamedTuple):
    """Words between blocks that a machine knows besides those of the dialect.

    Attributes
    ----------
    end, pause
        Marks that end the program and that pause it; letters alone.
    """

    end: tuple[str, ...] = ()
    pause: tuple[str, ...] = ()


STANDARD_MARKS = Marks()


UNITS = ("um", "mm", "inch")
"""Units in which the numbers of a program may be told to stand (docs/iso.md §4)."""


_REGISTER = re.compile(r"([DH])0*(\d{1,4})", re.ASCII | re.IGNORECASE)


Registers = tuple[tuple[str, float], ...]
"""Values of offset registers, µm, by their names."""


class OwnDialect(NamedTuple):
    """A dialect of a shop's own.

    Attributes
    ----------
    name
        As people call it; none of a profile.
    base
        Name of the profile that it changes.
    changed
        The values that it has in place of those, JSON.
    """

    name: str
    base: str
    changed: str

    def __str__(self) -> str:
        return self.name


ChosenDialect = str | OwnDialect
"""The name of a profile, or a dialect of one's own; empty where the text is to tell it."""


class Choices(NamedTuple):
    """What is told of a program besides its text, by options, settings and machine files.

    Attributes
    ----------
    marks
        Further marks.
    dialect
        Its dialect, such as ``fanuc``; empty where the text is to tell it.
    unit
        Of its numbers: ``um``, ``mm`` or ``inch``; empty where text and dialect tell it.
    registers
        Values of offset registers, µm, by their names without leading zeros: ``("D0", 100.0)``. What the program says
        itself counts before them.
    """

    marks: Marks = STANDARD_MARKS
    dialect: ChosenDialect = ""
    unit: str = ""
    registers: Registers = ()


STANDARD_CHOICES = Choices()


def register_name(text: str) -> str:
    """Name of an offset register in capitals and without leading zeros, ``D1`` of ``d01``; empty where it is none."""
    match = _REGISTER.fullmatch(text.strip())
    return f"{match[1].upper()}{match[2]}" if match else ""


def merged(tables: Iterable[Registers]) -> Registers:
    """Registers of several tables, by their names; where two give one, the later counts."""
    return tuple(sorted(dict(pair for table in tables for pair in table).items()))
