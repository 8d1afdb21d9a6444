"""What it takes to run the same again: versions, the program's check sum, and the files beside it."""

import hashlib
from typing import NamedTuple

from parser.text.encoding import encode_text
from sim.run.dryrun import DryRun
from sim.setup.machine.machine import Machine, machine_sections
from sim.setup.scenario import MACHINE_FILE, scenario_sections
from sim.setup.toml.writer import toml_text
from sim.workers.makers import Maker, versions


class Reproduction(NamedTuple):
    """How to run the same again.

    Attributes
    ----------
    command
        The command line, for a folder that holds the program and the files.
    program, sha256
        Name of the program, and the check sum of its bytes.
    files
        Name and content of the files beside the program.
    versions
        Of drycut, Python and the packages.
    """

    command: str
    program: str
    sha256: str
    files: tuple[tuple[str, str], ...]
    versions: Maker


def reproduction(run: DryRun) -> Reproduction:
    """What makes the same run again."""
    data = encode_text(run.program.text, run.program.encoding)
    scenario = run.scenario
    return Reproduction(
        command="drycut run . -o out" + _engine(scenario.machine),
        program=run.program.name,
        sha256=hashlib.sha256(data).hexdigest(),
        files=(
            ("scenario.toml", toml_text(scenario_sections(scenario))),
            (MACHINE_FILE, toml_text(machine_sections(scenario.machine))),
        ),
        versions=versions(),
    )


def _engine(machine: Machine) -> str:
    """The option of another engine than the usual one, which no file asks for."""
    return "" if machine.engine == Machine._field_defaults["engine"] else f" --engine {machine.engine}"
