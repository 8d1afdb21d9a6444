"""Tables, laid out by rich to the width there is, and paragraphs; printed line by line, and nothing is cut off."""

import io
from typing import Final

from rich.console import Console
from rich.segment import Segment
from rich.style import Style
from rich.table import Table
from rich.text import Text

from sim.show.terminal.printer import say, styled
from sim.show.terminal.streams import outlet
from sim.show.terminal.wrap import width_of, wrapped

_LINES: Final = 25  # rich asks the environment where one of width and height is not told


class _Nowhere(io.StringIO):
    """Tells rich the encoding of stdout, so that it draws frames that can be written."""

    encoding = property(lambda self: outlet().encoding)


def table(title: str, heads: tuple[str, ...] = ("", ""), right: tuple[int, ...] = ()) -> Table:
    """A table with a title; without heads, of names and values. Texts of the columns `right` end at one edge."""
    made = Table(title=Text(title), title_justify="left", title_style="bold", show_header=any(heads))
    for at, head in enumerate(heads):
        style = "" if any(heads) or at else "dim"
        made.add_column(head, justify="right" if at in right else "left", style=style, overflow="fold")
    return made


def show(shown_table: Table) -> None:
    """Print a table to stdout."""
    stream = outlet()
    console = Console(
        file=_Nowhere(),
        width=width_of(stream),
        height=_LINES,
        color_system="standard",
        markup=False,
        emoji=False,
        highlight=False,
        legacy_windows=False,
    )
    for line in console.render_lines(shown_table, pad=False):
        say("".join(map(_part, line)).rstrip())


def paragraph(text: str, style: str = "") -> None:
    """Print a text that may run on over several lines."""
    for line in wrapped(text, width_of(outlet())):
        say(styled(line, style))


def _part(segment: Segment) -> str:
    return styled(segment.text, _style(segment.style)) if segment.style else segment.text


def _style(style: Style) -> str:
    return " ".join(name for name, is_so in (("bold", style.bold), ("dim", style.dim)) if is_so)
