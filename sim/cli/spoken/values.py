"""Kinds of values of options: what is said of wrong ones, in both languages, and what a shell offers on TAB.

Kinds of values of options as click has them, but for what they say of wrong ones: that is in both languages.

What a shell offers on TAB where neither a choice nor a path is meant alone: click asks here for it.
"""

from typing import Any

import click
from click.shell_completion import CompletionItem

from parser.findings.errors import Message


class WholeNumber(click.IntRange):
    """A whole number, within bounds where there are some."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The number. BadParameter for another text, or a number out of the bounds."""
        try:
            number = int(value)
        except ValueError:
            self.fail(Message("no-integer", found=value), param, ctx)
        return _in_bounds(self, number, param, ctx)


class DecimalNumber(click.FloatRange):
    """A number within bounds, which "nan" passes."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The number. BadParameter for another text, or a number out of the bounds."""
        try:
            number = float(value)
        except ValueError:
            self.fail(Message("no-float", found=value), param, ctx)
        return _in_bounds(self, number, param, ctx)


class FilePath(click.Path):
    """Path of a file or of a folder, there or not."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The path. BadParameter where a folder has the name of a file that is meant, or the other way round."""
        try:
            return super().convert(value, param, ctx)
        except click.BadParameter:
            code = "directory-is-a-file" if self.dir_okay else "file-is-a-directory"
            self.fail(Message(code, path=click.format_filename(value)), param, ctx)


def _in_bounds(
    kind: click.IntRange | click.FloatRange, number: float, param: click.Parameter | None, ctx: click.Context | None
) -> float:
    low, high = kind.min, kind.max
    if (low is not None and number < low) or (high is not None and number > high):
        bounds = f"{'' if low is None else f'{low}<='}x{'' if high is None else f'<={high}'}"
        if high is None:
            bounds = f"x>={low}"
        kind.fail(Message("not-in-range", found=number, range=bounds), param, ctx)
    return number


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
    from sim.show.terminal.markdown import documents, title

    language = spoken()
    codes = [code for _, of_layer in layers(language) for code in of_layer]
    known = [(page_title, code) for code in codes] + [(title, name) for name in documents()]
    found = [(title_of, name) for title_of, name in known if name.lower().startswith(incomplete.lower())]
    return [CompletionItem(name, help=title_of(name, language)) for title_of, name in found]
