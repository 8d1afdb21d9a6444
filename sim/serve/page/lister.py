"""The process that checks the programs of a folder: files come as a line of JSON on stdin, rows go to stdout in order.

It has processes of its own, one a core; they end with it.
"""

import json
from pathlib import Path
from typing import Final

from parser.files import read_bytes
from parser.findings.errors import FileUnreadableError, in_both
from sim.base.workers.rounds import DIED, Lost, Processes, in_order, results
from sim.serve.page.child import read_request
from sim.serve.page.model import RowEntry
from sim.serve.page.programs import refused, row_or_why
from sim.show.terminal.printer import write
from sim.show.texts.phrases import same

_AT_ONCE: Final = 8
"""Files that are handed over together."""


def main() -> None:
    """Check all files that are asked for."""
    files = [(name, Path(file)) for name, file in read_request()]
    rows = in_order(results(_row, enumerate(files), Processes(), _AT_ONCE))
    for (name, _), row in zip(files, rows, strict=True):
        write(f"{json.dumps(refused(name, same(DIED)) if isinstance(row, Lost) else row)}\n", "json")


def _row(named_file: tuple[str, Path]) -> RowEntry:
    name, file = named_file
    try:
        data = read_bytes(file)
    except FileUnreadableError as error:
        return refused(name, in_both(error.detail or error.message))
    return row_or_why(name, file, data)


if __name__ == "__main__":
    main()
