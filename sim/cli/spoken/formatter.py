"""The help of a command in lines of a terminal: wide characters take two cells, and Chinese has no blanks to break at.

click counts characters, and breaks lines at blanks alone.
"""

from collections.abc import Iterable, Sequence

import click

from parser.text.excerpt import cells
from sim.cli.spoken.tongue import words
from sim.show.terminal.wrap import wrapped

_MOST_LEFT = 30  # cells of the left column; a longer name stands on a line of its own


class Formatter(click.HelpFormatter):
    """Writes usage, paragraphs and lists of two columns."""

    def write_usage(self, prog: str, args: str = "", prefix: str | None = None) -> None:
        """How the command is called."""
        head = words()("commands.usage") if prefix is None else prefix
        self._lines(wrapped(args, self.width, head=f"{head}{prog} "))

    def write_heading(self, heading: str) -> None:
        """A heading, with a colon."""
        self._lines([f"{heading}{words()('commands.colon')}"])

    def write_text(self, text: str) -> None:
        """A paragraph, or a line that is kept."""
        indent = " " * self.current_indent
        self._lines(wrapped(text, self.width, head=indent, indent=indent))

    def write_dl(self, rows: Iterable[tuple[str, str]], col_max: int = _MOST_LEFT, col_spacing: int = 2) -> None:
        """A list of two columns; what is behind a long name begins on the next line."""
        shown, indent = list(rows), " " * self.current_indent
        left = min(max((cells(name) for name, _ in shown), default=0), col_max) + col_spacing
        for name, told in shown:
            head = indent + name + " " * (left - cells(name))
            if cells(name) > left - col_spacing:
                self._lines([indent + name])
                head = indent + " " * left
            self._lines(wrapped(told, self.width, head=head))

    def _lines(self, lines: Sequence[str]) -> None:
        self.write("".join(f"{line}\n" for line in lines))
