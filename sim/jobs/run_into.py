"""What is written of a run: its picture, pages and report in one folder, its trace where asked for; all or none."""

from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Final

from controller.card.log import CardLog
from parser.findings.catalogue import Language
from parser.program import Program
from sim.base.files import StepFiles, staged
from sim.base.progress import Progress, silent
from sim.jobs.trace_file import TRACE, write_trace
from sim.run.dryrun import DryRun
from sim.run.recording import Recording, recording_of, reported, stages_of
from sim.run.report import report_text
from sim.run.report.model import ReportDocument
from sim.run.running import dry_run
from sim.run.sparks import has_panel, panel_cut
from sim.setup.scenario import Scenario
from sim.show.draw.sheet import pixels
from sim.show.panel_page.page import panel_page
from sim.show.pictures.cut.of_run import draw_cut_of_run
from sim.show.pictures.gallery import subject_of
from sim.show.pictures.inline import inline_pictures
from sim.show.replay.document import replay_page
from sim.show.report_page.page import report_page

FILES: Final = ("report.html", "replay.html", "cut.png", "report.json")
"""What every run writes."""
PANEL: Final = "panel.html"
"""What a run under sparks writes too."""
NAMES: Final = (*FILES, PANEL, TRACE)
"""What a run may write: of an earlier run none of these stays."""


def files_of(run: DryRun) -> tuple[str, ...]:
    """Names of what a run writes, its trace left out."""
    return (*FILES, PANEL) if has_panel(run) else FILES


def run_into(  # noqa: PLR0913 - what it is run with, and whom it tells
    folder: Path | str,
    program: Program,
    scenario: Scenario,
    progress: Progress = silent,
    log: CardLog | None = None,
    *,
    trace: bool = False,
    extra: Mapping[str, bytes] = MappingProxyType({}),
    language: Language = "en",
) -> DryRun:
    """Dry-run a program and write its files into a folder, and with `trace` every step and sample, `TRACE`.

    Without it a trace of an earlier run goes: none stands beside the files of another run. The calls to the card go to
    `log`. Files `extra`, by their names, are written as they are; ``cut.png`` is in one language, the pages in both.

    Raises ProgramError as `dry_run` does and FileUnreadableError where the folder cannot be written; then no file of
    the folder has changed.
    """
    with staged(Path(folder), [*NAMES, *extra]) as stage:
        with StepFiles(stage) as files:
            run, report = reported(dry_run(program, scenario, progress, files, log))
        recording = recording_of(run, files.paths, progress)
        write_files(recording, report, stage, progress, has_trace=trace, language=language)
        if trace:
            progress("trace", 0, 1)
            write_trace(stage, run, files.paths)
        for name, data in extra.items():
            (stage / name).write_bytes(data)
    return run


def stages_of_files(scenario: Scenario, *, trace: bool) -> list[str]:
    """The stages that `run_into` tells its progress of, in their order."""
    return [*stages_of(scenario), "pictures", "pages", *(["trace"] if trace else [])]


def write_files(  # noqa: PLR0913 - what was run, where to, and in which language
    recording: Recording,
    report: ReportDocument,
    folder: Path,
    progress: Progress,
    *,
    has_trace: bool = False,
    language: Language = "en",
) -> None:
    """Write `FILES`, under sparks `PANEL` too: the report and what people look at.

    Then nothing holds the files of the steps any more.
    """
    run, subject = recording.run, subject_of(recording)
    progress("pictures", 0, 1)
    sheet = pixels(language=language)
    draw_cut_of_run(sheet, run, recording.pieces, subject.shapes).image().save(folder / "cut.png", dpi=(200, 200))
    pictures = inline_pictures(subject, progress)
    progress("pages", 0, 3)
    (folder / "report.json").write_text(report_text(report), encoding="utf-8")
    progress("pages", 1, 3)
    (folder / "replay.html").write_text(replay_page(recording), encoding="utf-8")
    progress("pages", 2, 3)
    page = report_page(run, report, pictures, recording.pieces, has_trace=has_trace)
    (folder / "report.html").write_text(page, encoding="utf-8")
    if has_panel(run):
        (folder / PANEL).write_text(panel_page(run.scenario, panel_cut(run, run.scenario)), encoding="utf-8")
