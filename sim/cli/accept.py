"""``drycut accept``."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import click

from parser.findings.errors import Message
from sim.cli.options import Length, setting_options, taken_settings, with_options
from sim.cli.scenario_options import of_options
from sim.cli.spoken import Spoken, spoken, words
from sim.cli.spoken.values import FilePath
from sim.setup.part import MATERIAL, THICKNESS
from sim.setup.wire import DEFAULT_WIRE, DIAMETER

if TYPE_CHECKING:
    from sim.setup.technology import Choice, Technology

_NAMES = ("piece.dxf", "limits.toml")
_OF_CUT: Final = (DIAMETER, THICKNESS, MATERIAL)


@click.command(cls=Spoken)
@click.argument("file", type=FilePath(path_type=Path), metavar="FILE.csv", required=False)
@click.option("--limits", type=FilePath(path_type=Path, dir_okay=False), metavar="FILE.toml")
@click.option("--piece", type=FilePath(path_type=Path, file_okay=False), metavar="DIR")
@click.option("--offset", type=Length())
@with_options(setting_options(_OF_CUT))
@click.option("--pass", "number", type=click.IntRange(1, 20), default=1, show_default=True, metavar="N")
@click.option("-o", "--output", type=FilePath(path_type=Path, dir_okay=False), metavar="FILE.toml")
@click.option("--json", "as_json", is_flag=True)
def accept(  # noqa: PLR0913, PLR0917 - click hands over each option by its name
    file: Path | None,
    limits: Path | None,
    piece: Path | None,
    offset: float | None,
    number: int,
    output: Path | None,
    as_json: bool,
    **settings: Any,
) -> None:
    """Judge a measured test piece by its limits, or write the piece.

    \b
    drycut accept --piece piece/
    drycut accept measured.csv --limits piece/limits.toml
    drycut accept measured.csv --limits piece/limits.toml --offset 0.1mm
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    if piece is not None:
        _write(piece)
        return
    if file is None:
        raise click.MissingParameter(param_hint="FILE.csv", param_type="argument")
    if limits is None:
        raise click.MissingParameter(param_hint="--limits", param_type="option")
    from parser.text.encoding import printable
    from sim.measure.accept.gap import Cutting, measured_gap, technology_of
    from sim.measure.accept.judge import judged, read_piece
    from sim.measure.accept.model import document_text
    from sim.setup.limits import load_limits
    from sim.show.terminal.accept import print_judgement
    from sim.show.terminal.printer import say, write

    of_limits = load_limits(limits)
    done = judged(read_piece(file), of_limits)
    settings = dict(of_options(_OF_CUT, taken_settings(_OF_CUT, settings)))
    wire_um = settings.get(DIAMETER.name, DEFAULT_WIRE.diameter_um)
    if offset is None and (output is not None or settings):
        raise click.MissingParameter(param_hint="--offset", param_type="option")
    gap = None if offset is None else measured_gap(done, Cutting(offset, wire_um), of_limits.uncertainty_um)
    if gap is not None and output is not None:
        _add(technology_of(gap, _choice(settings, wire_um), number, printable(file.name)), output)
    if as_json:
        write(document_text(printable(str(file)), done, gap, words()), "json")
    else:
        print_judgement(done, gap, spoken())
        if output is not None:
            say(words()("commands.written", names=str(output)))
    raise click.exceptions.Exit(1 if done.verdict in {"fail", "incomplete"} else 0)


def _choice(settings: Mapping[str, Any], wire_um: float) -> "Choice":
    """What the technology is of. MissingParameter where nobody says the material or the height."""
    from sim.setup.technology import Choice

    for key in (MATERIAL, THICKNESS):
        if key.name not in settings:
            raise click.MissingParameter(param_hint=key.option, param_type="option")
    return Choice(settings[MATERIAL.name], wire_um, settings[THICKNESS.name])


def _add(technology: "Technology", output: Path) -> None:
    """Write a technology file, or add its cut to one that stands there. SettingsError where that has it already."""
    from parser.files import read_bytes
    from sim.base.files import staged
    from sim.setup.technology import load_technology, technology_sections
    from sim.setup.toml.keys import toml_text

    if output.suffix.lower() != ".toml":
        raise click.BadParameter(Message("technology-is-toml", output=output), param_hint="-o")
    before, sections = "", technology_sections(technology)
    if output.exists():
        load_technology(output)
        before = read_bytes(output).decode("utf-8").rstrip("\n") + "\n\n"
        sections = sections[1:]
    with staged(output.parent, [output.name]) as stage:
        (stage / output.name).write_text(before + toml_text(sections), encoding="utf-8", newline="\n")
        load_technology(stage / output.name)


def _write(folder: Path) -> None:
    """The drawing of the piece and its limits; nothing where one of them stands there."""
    from sim.base.files import staged
    from sim.make.piece import piece_dxf, piece_limits_text
    from sim.show.terminal.printer import say

    for name in _NAMES:
        if (folder / name).exists():
            raise click.BadParameter(Message("stands-there", file=folder / name), param_hint="--piece")
    with staged(folder, list(_NAMES)) as stage:
        for name, text in zip(_NAMES, (piece_dxf(), piece_limits_text()), strict=True):
            (stage / name).write_text(text, encoding="utf-8", newline="")
    say(words()("commands.written", names=", ".join(str(folder / name) for name in _NAMES)))
