"""What click says of wrong options and arguments, in the language of the command; it knows English alone."""

import click

from parser.findings.catalogue import in_language
from sim.cli.spoken.tongue import spoken, words


def localised(message: str) -> str:
    """A text in the language of the command, where it is a message; what a library says stays as it is."""
    return str(in_language(message, spoken()))


def complaint(error: click.ClickException) -> str:
    """The message of an error."""
    if spoken() == "en":
        return error.format_message()
    tell = words()
    if isinstance(error, click.NoSuchOption):
        told = tell("commands.no-option", name=error.option_name)
        near = ", ".join(error.possibilities or ())
        return told + (tell("commands.near", names=near) if near else "")
    if isinstance(error, click.MissingParameter):
        return tell("commands.missing", name=_named(error))
    if isinstance(error, click.BadParameter) and isinstance(getattr(error.param, "type", None), click.Choice):
        choices = tell("phrases.comma").join(map(str, error.param.type.choices))  # type: ignore[union-attr]  # told by getattr
        return tell("commands.no-choice", name=_named(error), choices=choices)
    if isinstance(error, click.BadParameter) and (error.param or error.param_hint):
        return tell("commands.bad-value", name=_named(error), why=localised(error.message))
    return localised(error.message)


def _named(error: click.BadParameter) -> str:
    """What the command line calls a parameter."""
    if error.param_hint is not None:
        return error.param_hint if isinstance(error.param_hint, str) else " / ".join(error.param_hint)
    if isinstance(error.param, click.Option):
        return max(error.param.opts, key=len)
    return str(getattr(error.param, "metavar", None) or "")
