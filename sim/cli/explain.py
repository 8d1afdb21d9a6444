"""``drycut explain``."""

import re
from collections.abc import Iterator
from typing import Final

import click

from parser.findings.catalogue import Language
from parser.findings.codes import CODES
from parser.findings.messages import Message, did_you_mean
from sim.cli.spoken import Spoken, spoken
from sim.cli.spoken.completing import offer_pages

_MOST_NEAR: Final = 3
"""Codes and documents that are named where one is misspelt."""


@click.command(cls=Spoken)
@click.argument("name", metavar="[CODE|DOCUMENT]", required=False, shell_complete=offer_pages)
@click.argument("sections", metavar="[SECTION]...", nargs=-1)
def explain(name: str | None, sections: tuple[str, ...]) -> None:
    """Show the page of a finding: what it is, why it matters, an example, how to mend it.

    \b
    drycut explain 3B204
    drycut explain 3b 2
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.show.terminal.colours import styled
    from sim.show.terminal.markdown import shown_lines
    from sim.show.terminal.printer import say
    from sim.show.terminal.streams import outlet
    from sim.show.terminal.wrap import width_of

    for text, is_heading in shown_lines(_markdown(name, sections, spoken()), width_of(outlet())):
        say(styled(text, "bold" if is_heading else ""))


def _markdown(name: str | None, sections: tuple[str, ...], language: Language) -> str:
    from sim.show.findings.pages import list_text, page_text
    from sim.show.terminal.documents import cited, document, documents, section

    if name is None:
        return list_text(language)
    code, of_documents = name.strip().upper(), {known.upper(): known for known in documents()}
    if code in CODES and not sections:
        return cited(page_text(code, language))
    if code not in of_documents:
        hint = did_you_mean(name, [*CODES, *documents()], Message("explain-lists-them"), most=_MOST_NEAR)
        raise click.UsageError(Message("nothing-to-explain", name=name, hint=hint))
    text = document(of_documents[code], language)
    try:
        return cited("\n\n".join(section(text, number) for number in _numbers(sections)) if sections else text)
    except KeyError as error:
        raise click.UsageError(Message("no-such-section", name=name, section=error.args[0])) from None


def _numbers(sections: tuple[str, ...]) -> Iterator[str]:
    """Numbers of sections, which may be written as pages cite them, such as ``§2``; what has none is taken whole."""
    for section in sections:
        yield from re.findall(r"\d+", section) or [section]
