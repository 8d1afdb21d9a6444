"""Mends of 3B blocks: which one field, written otherwise, would make a block right; the border type is `Mender`.

What looks for mends is imported when it is asked for: most programs need none, and start sooner without.
"""

from parser.controller_words import Axis
from parser.dialect.mender import Mend, Mender, Suspect
from parser.findings.findings import Edit
from parser.threeb import print_checks
from parser.threeb.mend import edits
from parser.toolpath import Toolpath


class _Mender:
    """Mends of 3B."""

    def suspects(self, toolpath: Toolpath, first_row: int, past_row: int) -> tuple[Suspect, ...]:
        from parser.threeb.mend.suspects import suspects  # noqa: PLC0415

        return suspects(toolpath, first_row, past_row)

    def one_slips(self, toolpath: Toolpath, first_row: int, past_row: int, most: int) -> tuple[Suspect, ...]:
        from parser.threeb.mend.suspects import one_slips  # noqa: PLC0415

        return one_slips(toolpath, first_row, past_row, most)

    def printed_mends(self, toolpath: Toolpath, row: int) -> tuple[Mend, ...]:
        from parser.threeb.mend.suspects import printed_mends  # noqa: PLC0415

        return printed_mends(toolpath, row)

    def is_misprint(self, toolpath: Toolpath, row: int) -> bool | None:
        return print_checks.is_misprint(toolpath, row)

    def ends_as_printed(self, toolpath: Toolpath, row: int) -> bool:
        return print_checks.ends_as_printed(toolpath, row)

    def turned(self, toolpath: Toolpath, row: int) -> Mend:
        return edits.turned(toolpath, row)

    def label_slips(self, toolpath: Toolpath, row: int) -> tuple[Mend, ...]:
        return edits.label_slips(toolpath, row)

    def other_labels(self, toolpath: Toolpath, row: int) -> tuple[Mend, ...]:
        return edits.other_labels(toolpath, row)

    def counted_on(self, axis: Axis) -> Mend:
        return edits.counted_on(axis)

    def counting(self, count_um: int) -> Mend:
        return edits.counting(count_um)

    def edit(self, toolpath: Toolpath, row: int, mend: Mend) -> Edit:
        return edits.edit(toolpath, row, mend)

    def mends_text(self, mends: tuple[Mend, ...]) -> str:
        return edits.mends_text(mends)


MENDER: Mender = _Mender()
