"""Start of the library in a program's process, where ``ges.c`` calls Python first."""

import os
from collections.abc import Callable
from typing import Any

from controller.card.abi.environment import card_environment
from controller.card.abi.table import digest
from controller.card.abi.turns import Tasks, all_tasks
from parser.findings.errors import SettingsError


def start(made_for: str, passed: memoryview) -> tuple[Callable[..., Any], ...]:
    """The functions of the library, as `Library.functions` has them.

    Parameters
    ----------
    made_for
        `digest` of what the library in C was made of.
    passed
        Memory of two counters of 64 bit: threads that came into the library, and that left it.

    SettingsError where the environment asks for what there is not, or the library was made by another drycut;
    FileUnreadableError where a file that it names cannot be read, or the log not be written.
    """
    if made_for != digest():
        raise SettingsError("libges-of-another-drycut")
    wanted = card_environment(os.environ)
    before = all_tasks()
    from controller.card.abi.library import Library  # noqa: PLC0415 - loads all else, and that begins threads

    return Library(wanted, Tasks(all_tasks() - before), passed.cast("Q")).functions()
