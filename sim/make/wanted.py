"""What a program is to be converted to, and the text that is written of a toolpath."""

import re
from dataclasses import replace
from pathlib import Path
from typing import Literal, NamedTuple

import numpy as np

from parser.dialect.reader import STANDARD_CHOICES, Choices
from parser.program import Program
from parser.toolpath import Toolpath
from parser.write.draft import (
    Draft,
    Event,
    Written,
    curve_marks,
    draft_of,
    events_of,
    with_rapid_to_start,
    without_rapids,
)
from parser.write.iso import IsoChoices, iso_choices, registers_of, written_iso
from parser.write.pmac import PmacChoices, blocks_of_text, ramp_of, written_pmac
from parser.write.threeb import Form, ThreeBChoices, with_codes, written_3b
from parser.write.two_contours import straightened

Language = Literal["3b", "4b", "iso", "pmac"]
_BOUND_STEPS = 3.0
"""Ends and centres in whole steps, and the middle of a long arc up to twice as far off as its centre; of 100,000 arcs
of any sweep none is farther off in ISO, and one in 3B, which has whole radii and counts too (docs/iso.md §10)."""


_OFFSET_BOUND_UM = 1.5
"""Of an offset path in 3B: of 2,000 programs with fillets at any angle none is farther off than 1.2 µm."""
_PMAC_BOUND_UM = 1.0
_INCHES = re.compile(r"G(?:20|70)(?!\d)", re.IGNORECASE)
_PMAC_DECIMALS = 5
_CHORD_STEPS = 0.5
"""How far lines that stand for arcs beside U and V leave them, in steps of the text."""


class Wanted(NamedTuple):
    """How a program is to be written.

    Attributes
    ----------
    language
        Its own.
    iso
        Choices of ISO; None for 3B and 4B.
    form
        Of 3B and 4B.
    keeps
        Whether compensation of its own stays with the controller.
    newline
        What ends a line.
    name
        Of the program, for headers.
    offset_um
        Offset that is worked in, for headers; None where none is known.
    end_code, pause_code
        Words of 3B and 4B in place of ``DD`` and ``D``; None for those. They go into the file alone: what is read back
        has the words that every reader knows.
    encoding
        Of the file.
    pmac
        Choices of PMAC; None for other languages.
    """

    language: Language
    iso: IsoChoices | None = None
    form: Form = "compact"
    keeps: bool = False
    newline: str = "\n"
    name: str = ""
    offset_um: float | None = None
    end_code: str | None = None
    pause_code: str | None = None
    encoding: str = "utf-8"
    pmac: PmacChoices | None = None

    @property
    def has_rapids(self) -> bool:
        """Whether the language has a word for a rapid."""
        return self.iso is not None or self.pmac is not None

    def bound_for_um(self, draft: Draft) -> float:
        """How far off the written path of a draft may be: less where no program had its centres."""
        return min(_OFFSET_BOUND_UM, self.bound_um) if draft.is_meant else self.bound_um

    @property
    def bound_um(self) -> float:
        """How far off the written path may be."""
        if self.pmac is not None:
            return _PMAC_BOUND_UM
        return _BOUND_STEPS * (1.0 if self.iso is None else max(1.0, self.iso.step_um))


def draft_for(toolpath: Toolpath, wanted: Wanted, events: tuple[Event, ...] = (), *, is_offset: bool = False) -> Draft:
    """What is to be written of a toolpath: 3B and 4B have no words for offsets, nor of their own for rapids.

    ISO has words for `events`. Of an offset path no centre is the programmer's: centre and count of 3B are chosen
    together, as near as whole µm let them.
    """
    draft = draft_of(toolpath)
    if is_offset and wanted.iso is None and wanted.pmac is None:
        draft = replace(draft, words=None, told_um=np.full_like(draft.told_um, np.nan), is_meant=True)
    if wanted.iso is not None:
        return begun(replace(draft, events=events), wanted)
    if wanted.pmac is not None:
        return draft.without_compensation()
    return (without_rapids(draft) if draft.words is None else draft).without_compensation()


def carried_events(program: Program, path: Toolpath, wanted: Wanted) -> tuple[Event, ...] | None:
    """Events of an ISO program, by the rows of its path, that are written in ISO; None where none can be placed.

    Dwells and optional stops mean the same everywhere; feeds and conditions stay in their own family and unit.
    """
    if wanted.iso is None or program.decoder is None:
        return None
    events = events_of(path)
    if events is None:
        return None
    is_inch = program.choices.unit == "inch" or _INCHES.search(program.text) is not None
    habitual = _habitual_dwells(program.reading.dialect)
    begins = set(np.flatnonzero(~path.is_jump & np.append(True, path.is_jump[:-1])).tolist())
    is_own = program.reading.dialect == wanted.iso.profile.name and is_inch == (wanted.iso.unit == "inch")
    return tuple(
        event
        for event in events
        if (is_own or event.is_common)
        and not (event.kind == "dwell" and event.number in habitual and event.after in begins)
    )


def _habitual_dwells(family: str) -> set[float]:
    """Dwells, s, that programs of a family have before each cut: each dialect writes its own there."""
    habits = iso_choices(family).habits
    return {float(word[1:]) for block in habits.before_cut if block.startswith("G04 ") for word in block.split()[1:]}


def begun(draft: Draft, wanted: Wanted) -> Draft:
    """A draft that begins as the dialect does that is written, and that its words of two contours can say."""
    if wanted.iso is None:
        return draft
    if draft.upper is not None and wanted.iso.habits.two_contours == "uv":
        draft = straightened(draft, _CHORD_STEPS * wanted.iso.step_um)
    return with_rapid_to_start(draft) if wanted.iso.habits.starts_by == "rapid" else draft


def written(draft: Draft, wanted: Wanted) -> Written:
    """The text of a draft, its lines ended as wanted. SettingsError where the dialect cannot say what it needs."""
    if wanted.iso is not None:
        made = written_iso(draft, wanted.iso)
    elif wanted.pmac is not None:
        made = _written_pmac(draft, wanted.pmac)
    else:
        marks = curve_marks(draft.curves) if wanted.language == "4b" else None
        made = written_3b(draft, ThreeBChoices(wanted.form, wanted.name, wanted.offset_um, marks))
    upper = made.upper and made.upper.replace("\n", wanted.newline)
    return made._replace(text=made.text.replace("\n", wanted.newline), upper=upper)


def upper_file(output: Path) -> Path:
    """Where the upper contour is written, beside the lower one: ``part-upper.3b`` of ``part.3b``."""
    return output.with_stem(f"{output.stem}-upper")


def _written_pmac(draft: Draft, choices: PmacChoices) -> Written:
    """A motion program of the blocks of its source, else of those that ISO in mm would have."""
    if choices.blocks is not None:
        blocks, row = choices.blocks, np.arange(len(draft))
    else:
        made = written_iso(draft, _plain_iso())
        blocks, row = blocks_of_text(made.text), made.row
    return Written(written_pmac(blocks, choices), row, ramp_of(blocks))


def _plain_iso() -> IsoChoices:
    """ISO of moves, places, pauses and an end alone, in hundredths of µm."""
    usual = iso_choices("common", "mm", _PMAC_DECIMALS)
    habits = replace(
        usual.habits, head=(), end="M02", before_cut=(), behind_cut=(), arc_feed="", starts_by="place", says_unit=False
    )
    return usual._replace(habits=habits, distance="absolute", centers="from-start", number_step=0, tape=False)


def encoded(text: str, wanted: Wanted) -> bytes:
    """Bytes of a file with a written text. Letters that its encoding does not have become question marks."""
    coded = text if wanted.iso is not None else with_codes(text, wanted.end_code, wanted.pause_code)
    return coded.encode(wanted.encoding, "replace")


def read_with(draft: Draft, wanted: Wanted) -> Choices:
    """What the written text is read with: its own dialect and unit, and the registers that it leaves to the table."""
    if wanted.iso is None:
        return STANDARD_CHOICES
    registers = registers_of(draft.compensation, wanted.iso)
    return Choices(dialect=wanted.iso.profile.name, unit=wanted.iso.reading_unit, registers=registers)
