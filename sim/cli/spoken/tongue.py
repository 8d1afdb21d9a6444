"""The language of a process: that which its command was asked for, else that of the locale.

What click says of wrong options and arguments, in the language of the command; it knows English alone.
"""

import os
from collections.abc import Sequence
from itertools import pairwise
from typing import Final

import click

from parser.findings.catalogue import LANGUAGES, Language, in_language
from sim.show.texts.texts import Words

OPTION: Final = "--lang"


class _Tongue:
    """What a command was asked for; threads of the process, such as that of the progress, share it."""

    chosen: Language | None = None


_TONGUE: Final = _Tongue()


def spoken() -> Language:
    """The language in which the command speaks."""
    return _TONGUE.chosen or of_locale()


def words() -> Words:
    """The texts in that language."""
    return Words(spoken())


def speak_as_asked(arguments: Sequence[str]) -> None:
    """Take the language from the arguments of a command: it holds for its help and for errors in them, too."""
    languages = [after for before, after in pairwise(arguments) if before == OPTION]
    joined = [argument.removeprefix(f"{OPTION}=") for argument in arguments if argument.startswith(f"{OPTION}=")]
    _TONGUE.chosen = next((language for language in LANGUAGES if language in {*languages, *joined}), None)


def of_locale() -> Language:
    """Chinese where the locale is, else English (POSIX: LC_ALL, LC_MESSAGES, LANG)."""
    locale = next((value for name in ("LC_ALL", "LC_MESSAGES", "LANG") if (value := os.environ.get(name))), "")
    return "zh" if locale.lower().startswith("zh") else "en"


def localised(message: str) -> str:
    """A text in the language of the command, where it is a message; what a library says stays as it is."""
    return str(in_language(message, spoken()))


def complaint(error: click.ClickException) -> str:
    """The message of an error."""
    if spoken() == "en":
        return error.format_message()
    tell = words()
    if isinstance(error, click.NoSuchOption):
        complaint_text = tell("commands.no-option", name=error.option_name)
        near = ", ".join(error.possibilities or ())
        return complaint_text + (tell("commands.near", names=near) if near else "")
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
