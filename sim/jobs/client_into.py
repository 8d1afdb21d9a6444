"""What is written of a program for the card: the files of its run, the log of its card, its calls as a text."""

import shutil
from pathlib import Path
from typing import Final

from controller.card.log import CardLogError
from sim.base.files import StepFiles, staged
from sim.base.progress import Progress, silent
from sim.clients.listing import NAME as CALLS
from sim.clients.run import ClientRun, Read, card_document, read_again, run_client, without_motion
from sim.clients.session import Ended, session_of
from sim.jobs.run_into import FILES, NAMES, write_files
from sim.run.recording import recording_of
from sim.run.report import build_report, report_text
from sim.run.report.model import ReportDocument
from sim.setup.scenario import Scenario

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
