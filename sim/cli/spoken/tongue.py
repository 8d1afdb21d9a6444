"""The language of a process: that which its command was asked for, else that of the locale."""

import os
from collections.abc import Sequence
from itertools import pairwise
from typing import Final

from parser.findings.catalogue import LANGUAGES, Language
from sim.show.words.words import Words

OPTION: Final = "--lang"


class _Tongue:
    """What a command was asked for; threads of the process, such as that of the progress, share it."""

    asked: Language | None = None


_TONGUE: Final = _Tongue()


def spoken() -> Language:
    """The language in which the command speaks."""
    return _TONGUE.asked or of_locale()


def words() -> Words:
    """The texts in that language."""
    return Words(spoken())


def speak_as_asked(arguments: Sequence[str]) -> None:
    """Take the language from the arguments of a command: it holds for its help and for errors in them, too."""
    beside = [after for before, after in pairwise(arguments) if before == OPTION]
    joined = [argument.removeprefix(f"{OPTION}=") for argument in arguments if argument.startswith(f"{OPTION}=")]
    _TONGUE.asked = next((language for language in LANGUAGES if language in {*beside, *joined}), None)


def of_locale() -> Language:
    """Chinese where the locale is, else English (POSIX: LC_ALL, LC_MESSAGES, LANG)."""
    locale = next((value for name in ("LC_ALL", "LC_MESSAGES", "LANG") if (value := os.environ.get(name))), "")
    return "zh" if locale.lower().startswith("zh") else "en"
