"""``drycut explain``."""

import click

from parser.findings.codes import CODES
from sim.cli.scenario_options import chosen


@click.command()
@click.argument("code", required=False)
@click.option("--lang", type=click.Choice(["en", "zh"]), help="Language; that of the locale where left out.")
def explain(code: str | None, lang: str | None) -> None:
    """Show the page of a finding: what it is, why it matters, an example, how to mend it.

    Without a code, list all codes with their titles.

    \b
    Exit code: 0 good, 2 bad use, 3 a fault of drycut itself.

    \b
    drycut explain 3B204
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.show.findings.pages import page_text, titles_text
    from sim.show.terminal.printer import write

    language = chosen(lang)
    if code is None:
        write(titles_text(language))
        return
    known = code.strip().upper()
    if known not in CODES:
        raise click.UsageError(f"no finding has the code {code!r}; drycut explain lists them all")
    write(page_text(known, language))
