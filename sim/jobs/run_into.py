"""What is written of a run, of a program for the card and of fault drills: all files of one folder, or none.

A run with its files: picture, pages and report in one folder, and its trace where asked for; all or none of them.

A program for the card, run, with its files: those of every run, the log of its card, and its calls as a text.

Fault drills with their files: the two pages, and the damaged programs beside them.
"""

import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Final

from controller.card.log import CardLog, CardLogError
from parser.findings.catalogue import Bilingual, Language
from parser.program import Program, usual_name
from sim.base.files import StepFiles, staged
from sim.base.progress import Progress, silent
from sim.clients.listing import NAME as CALLS
from sim.clients.run import ClientRun, Read, card_document, read_again, run_client, without_motion
from sim.clients.session import Ended, session_of
from sim.jobs.trace_file import TRACE, write_trace
from sim.process.cut import Started
from sim.run.dryrun import DryRun
from sim.run.recording import Recording, recording_of, reported, stages_of
from sim.run.report import build_report, report_text
from sim.run.report.model import ReportDocument
from sim.run.running import dry_run
from sim.run.sparks import has_panel, panel_cut
from sim.setup.scenario import Scenario
from sim.show.draw.sheet import pixels
from sim.show.drill_page import answers_page, drill_page
from sim.show.operation_page.page import operation_answers_page, operation_page
from sim.show.panel_page.page import panel_page
from sim.show.pictures.cut.of_run import draw_cut_of_run
from sim.show.pictures.gallery import subject_of
from sim.show.pictures.inline import inline_pictures
from sim.show.replay.document import replay_page
from sim.show.report_page.page import report_page
from sim.teach.drills import Drill
from sim.teach.operation.incidents import OperationDrill

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


LOG: Final = "card.log"
STAGES: Final = ("calls", "plan", "run", "pieces", "pictures", "pages")
"""Stages that `client_into` tells its progress of, in their order."""


def client_into(folder: Path, log: Path, ended: Ended, scenario: Scenario, progress: Progress = silent) -> ClientRun:
    """Run the calls of a log again and write the files of the run, the log and the calls into a folder.

    Of a program that moved neither X nor Y the pages and pictures are left out. CardLogError where the log holds no
    call or cannot be repeated, ProgramError where it makes more steps than any table does, FileUnreadableError where
    the folder cannot be written; then no file of it has changed.
    """
    progress("calls", 0, 1)
    read = read_log(log)
    with staged(folder, [*NAMES, LOG, CALLS]) as stage:
        shutil.copyfile(log, stage / LOG)
        (stage / CALLS).write_text(read.program.text, "utf-8")
        if not len(read.program.toolpath):
            at_rest = without_motion(read, scenario.title, ended)
            (stage / "report.json").write_text(report_text(at_rest), "utf-8")
            return ClientRun(read, ended, None, at_rest)
        with StepFiles(stage) as files:
            run = run_client(read, scenario, progress, files)
        report: ReportDocument = {**build_report(run), "card": card_document(read, ended)}
        write_files(recording_of(run, files.paths, progress), report, stage, progress)
    return ClientRun(read, ended, run, report)


def read_log(log: Path) -> Read:
    """A log read, and its calls made again. CardLogError where it holds no call."""
    if not log.exists():
        raise CardLogError("no-call-unlinked")
    with log.open(encoding="utf-8", newline="\n") as lines:
        session = session_of(LOG, lines)
    if not session.events:
        raise CardLogError("no-call")
    return read_again(LOG, session)


def names_of(done: ClientRun) -> tuple[str, ...]:
    """Names of the files that were written."""
    return (*(FILES if done.run else ("report.json",)), LOG, CALLS)


PAGES: Final = ("drill.html", "answers.html")
OPERATION_PAGES: Final = ("operation.html", "operation-answers.html")
"""Those of drills of operation."""


def drills_into(folder: Path, program: Program, drills: Sequence[Drill], number: int) -> None:
    """Write the drills of a set of a program, as one set of files or not at all.

    FileUnreadableError where the folder cannot be written.
    """
    names = drill_names(program, len(drills))
    with staged(folder, [*PAGES, *names]) as stage:
        (stage / PAGES[0]).write_text(drill_page(program, drills, number, names), "utf-8")
        (stage / PAGES[1]).write_text(answers_page(program, drills, number), "utf-8")
        for name, drill in zip(names, drills, strict=True):
            (stage / name).write_bytes(drill.program.text.encode(program.encoding))


def operation_into(folder: Path, title: Bilingual, cut: Started, drills: Sequence[OperationDrill], number: int) -> None:
    """Write the two pages of drills of operation, as one set of files or not at all.

    FileUnreadableError where the folder cannot be written.
    """
    pages = (operation_page, operation_answers_page)
    with staged(folder, OPERATION_PAGES) as stage:
        for name, page in zip(OPERATION_PAGES, pages, strict=True):
            (stage / name).write_text(page(title, cut, drills, number), "utf-8")


def drill_names(program: Program, count: int) -> list[str]:
    """Names of the files of so many damaged programs: they end as that of the sound one does, where that is a word."""
    suffix = Path(program.name).suffix
    if not (suffix.isascii() and suffix[1:].isalnum()):
        suffix = Path(usual_name(program.text)).suffix
    return [f"drill-{at:02}{suffix}" for at in range(1, count + 1)]
