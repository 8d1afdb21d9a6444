"""Checks of the examples on pages of findings, with the options and the files that a page gives."""

from pathlib import Path

from parser.findings.catalogue import Example
from sim.check.file_check import Job, check_file
from sim.check.result import CheckResult
from sim.check.settings import CheckSettings
from sim.setup.machine.machine import load_machine
from sim.setup.part import SIDES
from sim.setup.taper import TaperSettings, angle_of, read_upper


def checked(text: str, shown: Example, folder: Path) -> CheckResult:
    """A check of a text with the options of an example, whose files are put into a folder."""
    given = dict(zip(shown.options[::2], shown.options[1::2], strict=True))
    for name, content in shown.files.items():
        (folder / name).write_text(content.lstrip("\n"), "utf-8")
    machine = given.get("--machine", "")
    settings = CheckSettings(
        machine=load_machine(str(folder / machine) if machine in shown.files else machine) if machine else None,
        wire_diameter_um=180.0 if "--wire-diameter" in given else None,
        thickness_mm=40.0 if "--height" in given else None,
        taper=_taper(given, folder),
        dialect=given.get("--dialect", ""),
    )
    return check_file(Job("example.3b", text.lstrip("\n").encode(), settings))


def _taper(given: dict[str, str], folder: Path) -> TaperSettings | None:
    if "--upper" in given:
        return TaperSettings(upper=read_upper(folder / given["--upper"]))
    if "--taper" not in given:
        return None
    return TaperSettings(angle_of(given["--taper"], "--taper"), SIDES[given.get("--taper-side", "right")])
