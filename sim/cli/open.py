"""``drycut open``."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from sim.cli.spoken import Spoken, words
from sim.cli.spoken.values import FilePath, WholeNumber

if TYPE_CHECKING:
    from sim.serve.page.programs import Programs


@click.command(cls=Spoken)
@click.argument("file", required=False, type=FilePath(path_type=Path), metavar="[FILE|FOLDER]")
@click.option("--no-browser", is_flag=True)
@click.option("--port", type=WholeNumber(0, 65_535), default=0, metavar="N")
@click.option(
    "--shortcut",
    type=FilePath(path_type=Path, file_okay=False),
    metavar="DIR",
)
@click.option("--from-icon", is_flag=True, hidden=True)
def open(  # noqa: A001 - named as the command
    file: Path | None, no_browser: bool, port: int, shortcut: Path | None, from_icon: bool
) -> None:
    """Open a program in the browser, on this machine alone.

    \b
    drycut open part.3b
    drycut open programs/
    drycut open --shortcut ~/Desktop
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    import webbrowser

    from sim.serve.page.served import serve
    from sim.show.terminal.printer import say

    if shortcut is not None:
        from sim.serve.page.shortcut import write_shortcut

        say(words()("commands.written", names=", ".join(map(str, write_shortcut(shortcut)))))
        return

    def ready(address: str, way: Path) -> None:
        say(address)
        if not no_browser:
            webbrowser.open(way.as_uri())

    serve(_programs(file, from_icon=from_icon), port, ready)


def _programs(file: Path | None, *, from_icon: bool) -> "Programs":
    """What is to be open at the start. From an icon nobody reads a terminal: the page says what cannot be opened."""
    from parser.files import read_bytes
    from parser.findings.errors import FileUnreadableError
    from sim.serve.page.programs import Opened, Programs
    from sim.serve.page.recent import recent, remember

    if file is None:
        return Programs(Opened(recent=recent()))
    try:
        if file.is_dir():
            return Programs(Opened(folder=file))
        opened = Opened(file, read_bytes(file))
        remember(file)
        return Programs(opened)
    except FileUnreadableError as error:
        if not from_icon:
            raise
        return Programs(Opened(why=error.in_both(), recent=recent()))
