"""``drycut open``."""

from pathlib import Path

import click


@click.command(short_help="Open a program, or a folder of them, in the browser: see, edit, mend.")
@click.argument("file", required=False, type=click.Path(path_type=Path), metavar="[FILE|FOLDER]")
@click.option("--no-browser", is_flag=True, help="Start no browser; the address is the first line of the output.")
@click.option(
    "--port", type=click.IntRange(0, 65_535), default=0, metavar="N", help="Port; any free one where left out."
)
def open(file: Path | None, no_browser: bool, port: int) -> None:  # noqa: A001 - named as the command
    """Open a program in the browser, on this machine alone.

    The page shows the path, the findings and their mends at once, and again while the text is edited. Drop a file on
    it, paste one, or pick one. Nothing leaves the machine. Of a folder it lists all programs, with what the check says
    of each.

    \b
    Exit code: 0 when it was closed: by its button, by Ctrl-C, or when no page has
    been open for two minutes; 2 bad use or unreadable input, 3 a fault of drycut
    itself.

    \b
    drycut open part.3b
    drycut open programs/
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    import webbrowser

    from parser.files.reading import read_bytes
    from sim.open.programs import Opened
    from sim.open.served import serve
    from sim.show.terminal.printer import say

    if file is not None and file.is_dir():
        opened = Opened(folder=file)
    else:
        opened = Opened(file, read_bytes(file)) if file is not None else Opened()

    def ready(address: str) -> None:
        say(address)
        if not no_browser:
            webbrowser.open(address)

    serve(opened, port, ready)
