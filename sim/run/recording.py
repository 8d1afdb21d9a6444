"""A recorded run: the run and every step of it, which pictures, report and replay are made of; and its card's log.

The log of a run's card as a file, whole or not at all.
"""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np

from controller.card.core.settings import CardSettings
from controller.card.log import CardLog
from controller.stepping.pulses import Pulses
from parser.program import Program
from sim.base.files import StepFiles, scratch, staged
from sim.base.progress import Progress, silent
from sim.cut.pieces.pieces import Frame, Pieces
from sim.cut.regions import RegionError
from sim.cut.remains import pieces_left
from sim.cut.solids import solids_of, weighed
from sim.run.dryrun import DryRun
from sim.run.findings import expectation_findings
from sim.run.report import build_report
from sim.run.report.model import ReportDocument
from sim.run.running import dry_run
from sim.setup.expectations import missed
from sim.setup.scenario import Scenario

NO_PIECES = Pieces(Frame(None, None, None, ()), (), 0)
MOST_PASSES = 6.0
"""A contour cut once makes 0.8 of a pass, with three trim cuts 3. 1,900 turns on circles of 0.14 mm make 10 passes, and
their kerf takes 85 s."""


def stages_of(scenario: Scenario) -> list[str]:
    """The stages that a recorded run of a scenario tells its progress of, in their order."""
    has_cut = scenario.kerf or scenario.drawing is not None
    left = ["kerf", *(["comparison"] if scenario.drawing is not None else [])]
    return ["checks", "plan", "run", *(left if has_cut else ["pieces"])]


class Recording(NamedTuple):
    """A run and all its steps.

    Attributes
    ----------
    run
        What came of it.
    pieces
        What the cut leaves of the work (`pieces_of_run`).
    steps
        Every pulse, in program coordinates, in arrays that lie in files: take slices of them. The place before the
        first one is `sim.table.trace.origin_um` of the toolpath.
    """

    run: DryRun
    pieces: Pieces
    steps: Pulses


def recording_of(run: DryRun, files: Mapping[str, Path], progress: Progress) -> Recording:
    """The recording of a run from the finished files of its steps, which must stay where they are."""
    x, y, block, t_s = (
        np.load(files[f"step_{name}"], mmap_mode="r", allow_pickle=False) for name in ("x_um", "y_um", "block", "t_s")
    )
    if run.remains is None:
        progress("pieces", 0, 1)
    return Recording(run, pieces_of_run(run), Pulses(t_s, x[1:], y[1:], block - 1))


@contextmanager
def recorded(program: Program, scenario: Scenario, progress: Progress = silent) -> Iterator[Recording]:
    """Dry-run a program and keep its steps in files for as long as the context lasts.

    Raises what `dry_run` does, and FileUnreadableError where the steps cannot be written.
    """
    with scratch() as folder:
        with StepFiles(folder) as files:
            run = check_expectations(dry_run(program, scenario, progress, files))
        yield recording_of(run, files.paths, progress)


def check_expectations(run: DryRun) -> DryRun:
    """The run, with a finding for each expectation of its scenario that it does not meet."""
    return reported(run)[0] if run.scenario.expect else run


def reported(run: DryRun) -> tuple[DryRun, ReportDocument]:
    """The run as `check_expectations` has it, and its report."""
    report = build_report(run)
    unmet = missed(report, run.scenario.expect)
    if not unmet:
        return run, report
    run = replace(run, missed=unmet, findings=(*run.findings, *expectation_findings(unmet)))
    return run, build_report(run)


def pieces_of_run(run: DryRun) -> Pieces:
    """What the cut leaves of the work, worked out here where the scenario did not ask for it.

    `NO_PIECES` where it did not, and the path runs over itself so often that this would take minutes; and where they
    could not be worked out.
    """
    if run.remains is None and _passes(run) > MOST_PASSES:
        return NO_PIECES
    if run.remains is not None:
        return run.remains.pieces
    try:
        pieces = pieces_left(run.program, run.cut, run.contours, run.scenario, run.reach_um)
    except RegionError:
        return NO_PIECES
    if run.tilted is None:
        return pieces
    return weighed(pieces, solids_of(run.tilted, run.program, run.scenario))


def _passes(run: DryRun) -> float:
    """How often the wire runs through each place, by the squares as wide as the kerf that it meets."""
    kerf_um = run.scenario.wire.kerf_um
    column, row = np.floor(run.cut.wire_um / kerf_um).astype(np.int64).T
    met = len(np.unique(column * (1 << 32) + row))
    return float(run.toolpath.length_um[~run.toolpath.is_jump].sum()) / (met * kerf_um)


@contextmanager
def logging_to(path: Path | None, settings: CardSettings) -> Iterator[CardLog | None]:
    """Log that becomes the file `path`, a link followed, at the end of a block that raised nothing; none without.

    FileUnreadableError where the file cannot be written.
    """
    if path is None:
        yield None
        return
    target = path.resolve()
    with (
        staged(target.parent, [target.name]) as stage,
        (stage / target.name).open("w", encoding="utf-8", newline="\n") as stream,
    ):
        yield CardLog(stream, settings)
