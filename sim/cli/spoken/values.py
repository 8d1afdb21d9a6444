"""Kinds of values of options as click has them, but for what they say of wrong ones: that is in both languages."""

from typing import Any

import click

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
