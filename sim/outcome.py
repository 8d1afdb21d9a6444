"""A run with its files: picture, report and trace in one folder, whole or not at all."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from controller.card.log import CardLog
from parser.program import Program
from parser.units import mm
from sim.draw.outlines import Bodies
from sim.draw.picture import draw_cut
from sim.dryrun import DryRun, dry_run, verdict
from sim.judge import check_expectations
from sim.motion import Progress
from sim.output import StepFiles, staged, write_npz
from sim.report import build_report, report_text
from sim.scenario import Scenario
from sim.units import clock

if TYPE_CHECKING:
    from PIL import Image


FILES = ("cut.png", "report.json", "trace.npz")


def run_into(
    folder: Path,
    program: Program,
    scenario: Scenario,
    progress: Progress,
    log: CardLog | None = None,
) -> DryRun:
    """Dry-run a program and write ``cut.png``, ``report.json`` and ``trace.npz`` into a folder.

    The calls to the card go to `log`.

    Raises ProgramError as `dry_run` does and FileUnreadableError where the folder cannot be written; then no file of
    the folder has changed.
    """
    with staged(folder, FILES) as stage:
        with StepFiles(stage) as files:
            run = check_expectations(dry_run(program, scenario, progress, files, log))
        write_npz(stage / "trace.npz", files.paths, trace_arrays(run))
        (stage / "report.json").write_text(report_text(build_report(run)), encoding="utf-8")
        picture(run).save(stage / "cut.png", dpi=(200, 200))
    return run


def trace_arrays(run: DryRun) -> dict[str, NDArray[np.float64] | NDArray[np.int32]]:
    """Arrays of the table's trace, one entry a sample, the start first; µm and s, block numbers from 1."""
    trace = run.trace
    return {
        "t_s": trace.t_s,
        "x_um": trace.wire_um[:, 0],
        "y_um": trace.wire_um[:, 1],
        "table_x_um": trace.table_um[:, 0],
        "table_y_um": trace.table_um[:, 1],
        "commanded_x_um": trace.commanded_um[:, 0],
        "commanded_y_um": trace.commanded_um[:, 1],
        "block": (trace.row + 1).astype(np.int32),
    }


def picture(run: DryRun) -> "Image.Image":
    """The cut path of a run."""
    length = f"{mm(float(run.toolpath.length_um.sum())):.1f} mm"
    blocks = f"{len(run.toolpath):,} block{'s' * (len(run.toolpath) > 1)}"
    scenario = run.scenario
    note = f"{verdict(run.findings)} · {blocks} · {length} · {clock(run.plan.duration_s)}"
    if scenario.offset is not None:
        note += f" · offset {mm(scenario.offset.by_um):g} mm {scenario.offset.side.name.lower()}"
    bodies = Bodies(scenario.work_um, [clamp.outline_um for clamp in scenario.clamps])
    kerf_um = scenario.wire.kerf_um
    return draw_cut(run.toolpath, run.trace, kerf_um=kerf_um, title=scenario.title, note=note, bodies=bodies)
