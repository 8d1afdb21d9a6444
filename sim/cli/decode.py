"""``drycut decode``."""

from pathlib import Path
from typing import Any

import click

from parser.findings.errors import SettingsError
from sim.cli.scenario_options import chosen


class Register(click.ParamType):  # type: ignore[type-arg]  # generic in newer clicks alone
    """An offset register and its value with a unit, such as ``D0=0.1mm``."""

    name = "register"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> tuple[str, float]:
        """Its name without leading zeros, and its value in µm."""
        from sim.units import parse_length

        if isinstance(value, tuple):
            return value
        name, _, length = value.partition("=")
        letter, number = name.strip()[:1].upper(), name.strip()[1:]
        if letter not in {"D", "H"} or not number.isdecimal() or not length:
            raise SettingsError(f"{value!r} is no offset register with its value; write it such as D0=0.1mm")
        return f"{letter}{int(number)}", parse_length(length)


@click.command(short_help="Show how each block of an ISO program is decoded and compensated.")
@click.argument("path", type=click.Path(path_type=Path), metavar="PROGRAM")
@click.option("--block", "number", type=int, help="Only the blocks with this number behind N.")
@click.option("--json", "as_json", is_flag=True, help="Print the blocks as JSON.")
@click.option("--dialect", type=str, default="", help="Whose ISO it is, such as fanuc; the program tells it else.")
@click.option("--unit", type=click.Choice(["um", "mm", "inch"]), help="Unit of its numbers.")
@click.option("--offset", "registers", type=Register(), multiple=True, help="D0=0.1mm. May be repeated.")
@click.option("--lang", type=click.Choice(["en", "zh"]), help="Language; that of the locale where left out.")
def decode(  # noqa: PLR0913, PLR0917 - click hands over each option by its name
    path: Path,
    number: int | None,
    as_json: bool,
    dialect: str,
    unit: str | None,
    registers: tuple[tuple[str, float], ...],
    lang: str | None,
) -> None:
    """Show how a controller decodes an ISO program, block by block, and what it then does to each block.

    Each word sets a field of the block's buffer, in the order of the words. Then come the end of the contour, its place
    moved aside by the offset to either side, and how the block is joined to the one before.

    \b
    Exit code: 0 good, 2 bad use or unreadable input, 3 a fault of drycut itself.

    \b
    drycut decode part.iso
    drycut decode part.iso --block 6 --offset D11=0.1mm
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from parser.dialect.reader import Choices
    from parser.program import read_program
    from sim.decode.blocks import decoded
    from sim.decode.document import document_text
    from sim.show.terminal.decode import print_decoded
    from sim.show.terminal.printer import write
    from sim.show.words import Words

    language = chosen(lang)
    program = read_program(path, Choices(dialect=dialect, unit=unit or "", registers=registers))
    if program.decoder is None:
        raise click.UsageError(Words(language)("decode.not-iso", name=program.name, dialect=program.reading.dialect))
    blocks = [one for one in decoded(program) if number is None or one.block.number == number]
    if not blocks:
        raise click.UsageError(Words(language)("decode.none", name=program.name, block=number))
    if as_json:
        write(document_text(program, blocks), "json")
    else:
        print_decoded(program, blocks, language)
