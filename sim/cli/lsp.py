"""``drycut lsp``."""

import sys

import click

from sim.cli.spoken import Spoken

_STDOUT = 1
"""Number of the stream: the protocol is bytes, and what cleans texts for people must leave them alone."""


@click.command(cls=Spoken)
@click.option("--lang", type=click.Choice(["en", "zh"]))
def lsp(lang: str | None) -> None:
    """Speak the Language Server Protocol over stdin and stdout, for an editor that starts this."""
    from sim.serve.editor.server import language_server

    server = language_server("zh" if lang == "zh" else "en" if lang == "en" else None)
    with open(_STDOUT, "wb", closefd=False) as out:
        server.start_io(sys.stdin.buffer, out)
