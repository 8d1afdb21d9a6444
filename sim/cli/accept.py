"""``drycut accept``."""

from pathlib import Path

import click

from parser.findings.errors import Message
from sim.cli.spoken import Spoken, spoken, words
from sim.cli.spoken.values import FilePath

_NAMES = ("piece.dxf", "limits.toml")


@click.command(cls=Spoken)
@click.argument("file", type=FilePath(path_type=Path), metavar="FILE.csv", required=False)
@click.option("--limits", type=FilePath(path_type=Path, dir_okay=False), metavar="FILE.toml")
@click.option("--piece", type=FilePath(path_type=Path, file_okay=False), metavar="DIR")
@click.option("--json", "as_json", is_flag=True)
def accept(file: Path | None, limits: Path | None, piece: Path | None, as_json: bool) -> None:
    """Judge a measured test piece by its limits, or write the piece.

    \b
    drycut accept --piece piece/
    drycut accept measured.csv --limits piece/limits.toml
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    if piece is not None:
        _write(piece)
        return
    if file is None:
        raise click.MissingParameter(param_hint="FILE.csv", param_type="argument")
    if limits is None:
        raise click.MissingParameter(param_hint="--limits", param_type="option")
    from parser.text.encoding import printable
    from sim.measure.accept.judge import judged, read_piece
    from sim.measure.accept.model import document_text
    from sim.setup.limits import load_limits
    from sim.show.terminal.accept import print_judgement
    from sim.show.terminal.printer import write

    done = judged(read_piece(file), load_limits(limits))
    if as_json:
        write(document_text(printable(str(file)), done, words()), "json")
    else:
        print_judgement(done, spoken())
    raise click.exceptions.Exit(1 if done.verdict in {"fail", "incomplete"} else 0)


def _write(folder: Path) -> None:
    """The drawing of the piece and its limits; nothing where one of them stands there."""
    from sim.base.files import staged
    from sim.make.piece import piece_dxf, piece_limits
    from sim.show.terminal.printer import say

    for name in _NAMES:
        if (folder / name).exists():
            raise click.BadParameter(Message("stands-there", file=folder / name), param_hint="--piece")
    with staged(folder, list(_NAMES)) as stage:
        for name, text in zip(_NAMES, (piece_dxf(), piece_limits()), strict=True):
            (stage / name).write_text(text, encoding="utf-8", newline="")
    say(words()("commands.written", names=", ".join(str(folder / name) for name in _NAMES)))
