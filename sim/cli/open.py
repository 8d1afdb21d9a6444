"""``drycut open``."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from parser.findings.errors import Message
from sim.cli.spoken import Spoken, words
from sim.cli.spoken.values import FilePath, WholeNumber

if TYPE_CHECKING:
    from sim.serve.page.programs import Programs

_HAND_INS = "handed-in"


@click.command(cls=Spoken)
@click.argument("file", required=False, type=FilePath(path_type=Path), metavar="[FILE|FOLDER]")
@click.option("--no-browser", is_flag=True)
@click.option("--port", type=WholeNumber(0, 65_535), default=0, metavar="N")
@click.option(
    "--shortcut",
    type=FilePath(path_type=Path, file_okay=False),
    metavar="DIR",
)
@click.option("--class", "lesson", type=FilePath(path_type=Path, dir_okay=False), metavar="LESSON.toml")
@click.option("--network", is_flag=True)
@click.option("--hand-ins", type=FilePath(path_type=Path, file_okay=False), metavar="DIR")
@click.option("--from-icon", is_flag=True, hidden=True)
def open(  # noqa: A001, PLR0913, PLR0917 - named as the command; click hands over each option by its name
    file: Path | None,
    no_browser: bool,
    port: int,
    shortcut: Path | None,
    lesson: Path | None,
    network: bool,
    hand_ins: Path | None,
    from_icon: bool,
) -> None:
    """Open a program in the browser, on this machine alone; or a lesson, for a class in the network on purpose only.

    \b
    drycut open part.3b
    drycut open programs/
    drycut open --shortcut ~/Desktop
    drycut open --class lesson.toml --network
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    import webbrowser

    from sim.serve.page.served import serve
    from sim.show.terminal.printer import say

    if shortcut is not None:
        from sim.serve.page.shortcut import write_shortcut

        say(words()("commands.written", names=", ".join(map(str, write_shortcut(shortcut)))))
        return

    if lesson is not None:
        if file is not None:
            raise click.UsageError(Message("class-or-file"))
        _serve_class(lesson, hand_ins or Path(_HAND_INS), port, network=network, no_browser=no_browser)
        return
    if network or hand_ins is not None:
        raise click.UsageError(Message("class-options"))

    def ready(address: str, way: Path) -> None:
        say(address)
        if not no_browser:
            webbrowser.open(way.as_uri())

    serve(_programs(file, from_icon=from_icon), port, ready)


def _serve_class(lesson: Path, folder: Path, port: int, *, network: bool, no_browser: bool) -> None:
    """Serve a lesson until Ctrl-C; what pupils hand in is written into a folder."""
    import webbrowser

    from sim.jobs.lessons import lesson_of
    from sim.serve.classroom.served import Opened, serve_class
    from sim.show.terminal.printer import say

    def say_it(opened: Opened) -> None:
        say(opened.teacher)
        if opened.pupils:
            say(words()("class.served-network", addresses=", ".join(opened.pupils), code=opened.code))
        say(words()("class.served-into", folder=folder))
        if not no_browser:
            webbrowser.open(opened.way.as_uri())

    serve_class(lesson_of(lesson), folder, port, network=network, on_open=say_it)


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
