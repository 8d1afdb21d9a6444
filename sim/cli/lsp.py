"""``drycut lsp``."""

import sys

import click

_STDOUT = 1
"""Number of the stream: the protocol is bytes, and what cleans texts for people must leave them alone."""


@click.command(short_help="Speak the Language Server Protocol, for editors.")
@click.option("--lang", type=click.Choice(["en", "zh"]), help="Language of messages; else that of the editor.")
def lsp(lang: str | None) -> None:
    """Speak the Language Server Protocol over stdin and stdout, for an editor that starts this.

    Findings while one types, mends as quick fixes, the geometry of the block under the pointer, the figures as an
    outline, and layout in columns, for 3B, 4B, ISO and PMAC programs (docs/editor.md).

    \b
    Exit code: 0 when the editor ends it, 3 a fault of drycut itself.
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.editor.server import language_server

    server = language_server("zh" if lang == "zh" else "en" if lang == "en" else None)
    with open(_STDOUT, "wb", closefd=False) as out:
        server.start_io(sys.stdin.buffer, out)
