"""The table by block."""

from collections.abc import Mapping
from typing import Any

from sim.run.dryrun import DryRun
from sim.show.report_page.findings import address
from sim.show.report_page.tables import Column, Table, column_of, counted, micrometres, millimetres, timed, worded
from sim.show.words.report import said

CodeLink = tuple[str, str]
"""A code, and the address in the page of the finding that bears it."""


def block_table(run: DryRun, report: Mapping[str, Any]) -> Table:
    """Every block of the run, as ``blocks[]`` of the report has it."""
    blocks = report["blocks"]

    def of(path: str) -> list[Any]:
        return column_of(blocks, path)

    return Table(
        "blocks",
        (
            counted("block", of("block")),
            counted("line", of("line")),
            Column(said("text"), of("text"), "code"),
            worded("kind", of("kind"), "kind"),
            counted("count-length", of("count_um")),
            Column(said("count-axis"), [axis and f"G{axis}" for axis in of("count_axis")], "code"),
            millimetres("from-x", of("exact.start_um.0")),
            millimetres("from-y", of("exact.start_um.1")),
            millimetres("to-x", of("exact.end_um.0")),
            millimetres("to-y", of("exact.end_um.1")),
            millimetres("radius", of("exact.radius_um")),
            millimetres("length", of("exact.length_um")),
            counted("steps", of("stepped.steps")),
            timed("seconds", report["time_s"]["by_block"]),
            micrometres("step-deviation", of("stepped.max_deviation_um")),
            micrometres("table-off", of("table.max_deviation_um")),
            Column(said("codes"), _codes(run), "codes"),
        ),
    )


def _codes(run: DryRun) -> list[list[CodeLink]]:
    """Codes of the findings on each block; findings name blocks of the program, which an offset may have several of."""
    by_block: dict[int, list[CodeLink]] = {}
    for at, finding in enumerate(run.findings):
        by_block.setdefault(finding.block, []).append((finding.code, address(at)))
    return [by_block.get(block, []) for block in run.toolpath.source.block.tolist()]
