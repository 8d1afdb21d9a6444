"""What ``drycut check`` writes, a module a format.

Each has a function `render`, which takes the results of the files in their order, one at a time, and yields text as it
goes: tens of thousands of files are never held at once. `render` here picks the module by the format's name.
"""

import importlib
from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType
from typing import NamedTuple

from sim.check.result import CheckResult
from sim.show.findings.wording import Options
from sim.show.terminal.printer import Form


class Format(NamedTuple):
    """Module of a format, which is imported when it is asked for; what the printer takes its text for."""

    module: str
    form: Form


FORMATS: Mapping[str, Format] = MappingProxyType(
    {
        "text": Format("sim.show.findings.text", "text"),
        "concise": Format("sim.show.findings.concise", "text"),
        "json": Format("sim.show.findings.json", "json"),
        "sarif": Format("sim.show.findings.sarif", "json"),
        "junit": Format("sim.show.findings.junit", "xml"),
        "github": Format("sim.show.findings.github", "github"),
        "gitlab": Format("sim.show.findings.gitlab", "json"),
    }
)
"""Only the format asked for is imported, which keeps the command quick to start."""


def render(name: str, results: Iterable[CheckResult], options: Options) -> Iterator[str]:
    """Text of the results in a format of `FORMATS`, in pieces."""
    pieces: Iterator[str] = importlib.import_module(FORMATS[name].module).render(results, options)
    return pieces
