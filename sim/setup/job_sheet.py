"""What a shop writes on the sheet of a job and no run needs: which part it is, of what, how many, and the generator."""

from typing import Final, NamedTuple

from sim.setup.toml.keys import Key, Section
from sim.setup.toml.kinds import Name


class JobFields(NamedTuple):
    """Fields of the job sheet as they are written there; None of those that are left to be filled in by hand."""

    part_number: str | None = None
    material: str | None = None
    pieces: str | None = None
    pulse_on: str | None = None
    pulse_off: str | None = None
    current: str | None = None
    wire_speed: str | None = None


SHEET: Final = Section("sheet", tuple(Key(name, Name(), default=None) for name in JobFields._fields), fills="sheet")
