"""What a shell offers on TAB where neither a choice nor a path is meant alone: click asks here for it."""

import click
from click.shell_completion import CompletionItem


def offer_files(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """Files and folders; the shell itself looks for them."""
    return [CompletionItem(incomplete, type="file")]


def offer_machines(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """The machines that drycut knows, and files."""
    from sim.setup.machine.machine import machine_names

    known = [CompletionItem(name) for name in machine_names() if name.startswith(incomplete)]
    return [*known, *offer_files(ctx, param, incomplete)]


def offer_examples(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """The examples that come with drycut."""
    from sim.jobs.examples import example_names

    return [CompletionItem(name) for name in example_names() if name.startswith(incomplete)]


def offer_pages(ctx: click.Context, param: click.Parameter, incomplete: str) -> list[CompletionItem]:
    """The codes of findings, with their titles, and the documents."""
    from sim.cli.spoken import spoken
    from sim.show.findings.pages import layers, page_title
    from sim.show.terminal.documents import documents, title

    language = spoken()
    codes = [code for _, of_layer in layers(language) for code in of_layer]
    known = [(page_title, code) for code in codes] + [(title, name) for name in documents()]
    found = [(title_of, name) for title_of, name in known if name.lower().startswith(incomplete.lower())]
    return [CompletionItem(name, help=title_of(name, language)) for title_of, name in found]
