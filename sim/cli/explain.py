"""``drycut explain``."""

import re
from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

import click

from parser.findings.catalogue import Language
from parser.findings.codes import CODES
from parser.findings.errors import Message, did_you_mean
from sim.cli.spoken import Spoken, spoken
from sim.cli.spoken.values import offer_pages

if TYPE_CHECKING:
    from sim.show.findings.explained import Pages

_MOST_NEAR: Final = 3
"""Codes and documents that are named where one is misspelt."""


@click.command(cls=Spoken)
@click.argument("name", metavar="[CODE|DOCUMENT]", required=False, shell_complete=offer_pages)
@click.argument("sections", metavar="[SECTION]...", nargs=-1)
@click.option("--search", metavar="WORDS")
@click.option("--json", "as_json", is_flag=True)
def explain(name: str | None, sections: tuple[str, ...], *, search: str | None, as_json: bool) -> None:
    """Show the page of a finding: what it is, why it matters, an example, how to mend it.

    \b
    drycut explain 3B204
    drycut explain 3b 2
    drycut explain --search "count axis"
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.check.own_checks import load_own_checks

    load_own_checks()
    if search is not None and name is not None:
        raise click.UsageError(Message("options-exclude-each-other", options="--search and CODE"))
    if sections and as_json:
        raise click.UsageError(Message("options-exclude-each-other", options="--json and SECTION"))
    if as_json:
        _write_json(name, search, spoken())
    elif search is not None:
        _show(_found_markdown(search, spoken()))
    else:
        _show(_markdown(name, sections, spoken()))


def _show(markdown: str) -> None:
    from sim.show.terminal.markdown import shown_lines
    from sim.show.terminal.printer import say, styled
    from sim.show.terminal.streams import outlet
    from sim.show.terminal.wrap import width_of

    for text, is_heading in shown_lines(markdown, width_of(outlet())):
        say(styled(text, "bold" if is_heading else ""))


def _write_json(name: str | None, search: str | None, language: Language) -> None:
    from sim.show.findings.explained import Pages, every_page, explain_text
    from sim.show.terminal.printer import write

    found = _found(search) if search is not None else every_page()
    if name is not None:
        code, of_documents = _known(name)
        found = Pages((code,) if code else (), () if code else (of_documents,))
    write(explain_text(found, language, is_whole=name is not None), "json")


def _found(search: str) -> "Pages":
    """Pages that have all the words; UsageError where there are none."""
    from sim.show.findings.explained import pages_with

    words = search.split()
    found = pages_with(words)
    if not words or not any(found):
        raise click.UsageError(Message("nothing-found", words=search))
    return found


def _found_markdown(search: str, language: Language) -> str:
    from sim.show.findings.explained import found_text

    return found_text(_found(search), language)


def _known(name: str) -> tuple[str, str]:
    """The code of a name, or else the document; the other is empty. UsageError, with names like it, for neither."""
    from sim.show.terminal.markdown import documents

    code, of_documents = name.strip().upper(), {known.upper(): known for known in documents()}
    if code in CODES:
        return code, ""
    if code in of_documents:
        return "", of_documents[code]
    hint = did_you_mean(name, [*CODES, *documents()], Message("explain-lists-them"), most=_MOST_NEAR)
    raise click.UsageError(Message("nothing-to-explain", name=name, hint=hint))


def _markdown(name: str | None, sections: tuple[str, ...], language: Language) -> str:
    from sim.show.findings.pages import list_text, page_text
    from sim.show.terminal.markdown import cited, document, section

    if name is None:
        return list_text(language)
    code, of_documents = _known(name)
    if code and sections:
        raise click.UsageError(Message("no-such-section", name=name, section=sections[0]))
    if code:
        return cited(page_text(code, language))
    text = document(of_documents, language)
    try:
        return cited("\n\n".join(section(text, number) for number in _numbers(sections)) if sections else text)
    except KeyError as error:
        raise click.UsageError(Message("no-such-section", name=name, section=error.args[0])) from None


def _numbers(sections: tuple[str, ...]) -> Iterator[str]:
    """Numbers of sections, which may be written as pages cite them, such as ``§2``; what has none is taken whole."""
    for section in sections:
        yield from re.findall(r"\d+", section) or [section]
