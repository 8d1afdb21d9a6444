"""``drycut decode``."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from parser.findings.errors import Message, ProgramError
from sim.cli.options import RegisterSet, RegisterValue, with_dialect
from sim.cli.scenario_options import describe
from sim.cli.spoken import Spoken, spoken
from sim.cli.spoken.values import FilePath, WholeNumber

if TYPE_CHECKING:
    from collections.abc import Sequence

    from controller.decode.blocks import Decoded
    from parser.dialect.reader import ChosenDialect


@click.command(cls=Spoken)
@click.argument("path", type=FilePath(path_type=Path), metavar="PROGRAM")
@click.option(
    "--block",
    "number",
    type=WholeNumber(0),
    metavar="INTEGER",
)
@click.option("--json", "as_json", is_flag=True)
@with_dialect
@click.option("--offset", "registers", type=RegisterValue(), multiple=True)
def decode(  # noqa: PLR0913, PLR0917 - click hands over each option by its name
    path: Path,
    number: int | None,
    as_json: bool,
    dialect: "ChosenDialect | None",
    unit: str | None,
    registers: tuple[RegisterSet, ...],
) -> None:
    """Show how a controller decodes an ISO program, block by block, and what it then does to each block.

    \b
    drycut decode part.iso
    drycut decode part.iso --block 6 --offset D11=0.1mm
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from controller.decode.blocks import decoded
    from controller.decode.document import document_text
    from parser.dialect.reader import Choices
    from parser.program import read_program
    from sim.show.terminal.decode import print_decoded
    from sim.show.terminal.printer import say, write

    language = spoken()
    try:
        program = read_program(path, Choices(dialect=dialect or "", unit=unit or "", registers=registers))
    except ProgramError as error:
        for line in describe(str(path), error):
            say(line, err=True)
        raise click.exceptions.Exit(2) from None
    if program.decoder is None:
        raise click.UsageError(Message("not-decoded", name=program.name, dialect=program.reading.dialect))
    blocks = _chosen(decoded(program, program.toolpath), number)
    if not blocks:
        raise click.UsageError(Message("no-block-of-number", name=program.name, block=number))
    if as_json:
        write(document_text(program, blocks, language), "json")
    else:
        print_decoded(program, blocks, language)


def _chosen(blocks: "Sequence[Decoded]", number: int | None) -> "Sequence[Decoded]":
    """The blocks with a number; all without one."""
    if number is None:
        return blocks
    if all(decoded.block.number is None for decoded in blocks):
        return blocks[number - 1 : number] if number > 0 else ()
    return [decoded for decoded in blocks if decoded.block.number == number]
