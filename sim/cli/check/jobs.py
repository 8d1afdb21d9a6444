"""The jobs of a check: its files, each with the settings that count for it."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

from parser.files.reading import read_stdin
from parser.units import mm
from sim.check.batch import Job
from sim.check.files import find_files
from sim.check.settings import CheckSettings, code_list, settings_near, severity
from sim.setup.toml.reader import number
from sim.setup.wire import SPARK_GAP_MM, WIRE_DIAMETER_MM

STDIN = "-"


class Asked(NamedTuple):
    """Options of the command line that take the place of settings; None where one is left out. Lengths in µm."""

    select: str | None
    ignore: str | None
    fail_on: str | None
    machine: str | None
    wire_diameter: float | None
    gap: float | None


def jobs_of(names: Sequence[str], asked: Asked) -> list[Job]:
    """A job for each file that the names lead to.

    Raises FileUnreadableError for a name that leads to none, SettingsError for settings that cannot be.
    """
    options = _settings(asked)
    return [_job(name, options) for name in find_files(names)]


def _settings(asked: Asked) -> dict[str, Any]:
    """Settings that the command line gives, in place of those of the files."""
    given: dict[str, Any] = {}
    if asked.select is not None:
        given["select"] = code_list(asked.select.split(","), "--select")
    if asked.ignore is not None:
        given["ignore"] = code_list(asked.ignore.split(","), "--ignore")
    if asked.fail_on is not None:
        given["fail_on"] = severity(asked.fail_on, "--fail-on")
    if asked.machine is not None:
        from sim.setup.machine.machine import load_machine

        given["machine"] = load_machine(asked.machine)
    if asked.wire_diameter is not None:
        number(mm(asked.wire_diameter), WIRE_DIAMETER_MM, "--wire-diameter in mm")
        given["wire_diameter_um"] = asked.wire_diameter
    if asked.gap is not None:
        number(mm(asked.gap), SPARK_GAP_MM, "--gap in mm")
        given["spark_gap_um"] = asked.gap
    return given


def _job(name: str, options: dict[str, Any]) -> Job:
    path = Path() if name == STDIN else Path(name).parent
    settings: CheckSettings = replace(settings_near(path), **options)
    _ = settings.demands  # settings that contradict each other are told before the first file
    if name == STDIN:
        return Job("<stdin>", read_stdin(), settings)
    return Job(name, Path(name), settings)
