"""What ``drycut check`` writes, a module a format.

Each has a function `render`, which takes the results of the files in their order, one at a time, and yields text as it
goes: tens of thousands of files are never held at once. `render` here picks the module by the format's name.
"""

import importlib
from collections.abc import Iterable, Iterator, Mapping
from types import MappingProxyType

from sim.check.result import CheckResult
from sim.show.findings.options import Options

FORMATS: Mapping[str, str] = MappingProxyType(
    {
        "text": "sim.show.findings.text",
        "concise": "sim.show.findings.concise",
        "json": "sim.show.findings.json",
        "sarif": "sim.show.findings.sarif",
        "junit": "sim.show.findings.junit",
        "github": "sim.show.findings.github",
        "gitlab": "sim.show.findings.gitlab",
    }
)
"""Format -> module; only the one asked for is imported, which keeps the command quick to start."""


def render(name: str, results: Iterable[CheckResult], options: Options) -> Iterator[str]:
    """Text of the results in a format of `FORMATS`, in pieces."""
    pieces: Iterator[str] = importlib.import_module(FORMATS[name]).render(results, options)
    return pieces
