"""A run with its files: picture, pages, report and trace in one folder, whole or not at all."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from controller.card.log.writer import CardLog
from parser.program import Program
from sim.files import StepFiles, staged, write_npz
from sim.run.dryrun import DryRun, dry_run
from sim.run.recording import Recording, check_expectations, recording_of
from sim.run.report import build_report, report_text
from sim.setup.scenario import Scenario
from sim.show.draw.sheet import pixels
from sim.show.pictures.cut.of_run import draw_cut_of_run
from sim.show.pictures.inline import inline_pictures
from sim.show.replay.document import replay_page
from sim.show.report_page.page import report_page
from sim.table.motion import Progress, silent

FILES = ("report.html", "replay.html", "cut.png", "report.json", "trace.npz")


def run_into(
    folder: Path | str,
    program: Program,
    scenario: Scenario,
    progress: Progress = silent,
    log: CardLog | None = None,
) -> DryRun:
    """Dry-run a program and write `FILES` into a folder.

    The calls to the card go to `log`.

    Raises ProgramError as `dry_run` does and FileUnreadableError where the folder cannot be written; then no file of
    the folder has changed.
    """
    with staged(Path(folder), FILES) as stage:
        with StepFiles(stage) as files:
            run = check_expectations(dry_run(program, scenario, progress, files, log))
        _show(recording_of(run, files.paths, progress), stage, progress)
        write_npz(stage / "trace.npz", files.paths, trace_arrays(run))
    return run


def _show(recording: Recording, folder: Path, progress: Progress) -> None:
    """Write the report and what people look at; then nothing holds the files of the steps any more."""
    run, report = recording.run, build_report(recording.run)
    (folder / "report.json").write_text(report_text(report), encoding="utf-8")
    draw_cut_of_run(pixels(), run, recording.pieces).image().save(folder / "cut.png", dpi=(200, 200))
    (folder / "replay.html").write_text(replay_page(recording), encoding="utf-8")
    pictures = inline_pictures(recording, progress)
    (folder / "report.html").write_text(report_page(run, report, pictures), encoding="utf-8")


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
