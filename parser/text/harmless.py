"""Lines that a terminal shows and a build server logs, and neither obeys: what is no text, and commands of CI systems.

What is made harmless, each character by one U+FFFD, so that places in a line stay:

* what is no text for people, as `printable` has it: escape sequences lose their ESC, lines cannot run backwards;
* ``##name[``, anywhere: Azure's agent looks for ``##vso[`` in the whole line, GitHub's runner for ``##[``
  (actions/runner, src/Runner.Common/ActionCommand.cs: TryParse), TeamCity for ``##teamcity[``;
* ``::`` at the start of a line, behind blanks (the same file, TryParseV2: it trims them), and inside where the name of
  a command of GitHub follows and ``::`` comes after it;
* ``section_start:1:`` and ``section_end:1:``, which GitLab takes for the borders of a section
  (lib/gitlab/ci/ansi2json/converter.rb).

The first two compare as people read (.NET, StringComparison.CurrentCulture): characters without a width or a weight do
not count, so that they may stand between the signs.
"""

import re
from collections.abc import Callable
from typing import Final

from parser.text.encoding import REPLACED, printable

# Default_Ignorable_Code_Point (Unicode 15, DerivedCoreProperties.txt), of which `printable` leaves these.
_UNSEEN: Final = "".join(
    f"\\U{first:08x}-\\U{last:08x}"
    for first, last in (
        *((0x34F, 0x34F), (0x115F, 0x1160), (0x17B4, 0x17B5), (0x180B, 0x180D), (0x180F, 0x180F), (0x3164, 0x3164)),
        *((0xFE00, 0xFE0F), (0xFFA0, 0xFFA0), (0xE0100, 0xE01EF)),
    )
)
# docs.github.com, "Workflow commands", and actions/runner, src/Runner.Worker/ActionCommandManager.cs.
_GITHUB: Final = (
    "add-mask|add-matcher|add-path|debug|echo|endgroup|error|group|internal-set-repo-path|notice|remove-matcher|"
    "save-state|set-env|set-output|stop-commands|warning"
)
_COMMAND: Final = re.compile(
    rf"""
      \#(?=[{_UNSEEN}]*\#[\w.{_UNSEEN}-]*\[)
    | (?:(?<=section_start)|(?<=section_end)):(?=[{_UNSEEN}]*\d)
    | :(?=:(?:{_GITHUB})(?:\s(?:[^:]|:(?!:))*+)?::)
    """,
    re.VERBOSE | re.IGNORECASE,
)
_AT_START: Final = re.compile(rf"([\s{_UNSEEN}]*):(?=[{_UNSEEN}]*:)")


def harmless(line: str) -> str:
    """A line as it may be shown to people and logged; it has as many characters as before.

    A line feed is no part of a line: it becomes U+FFFD like all other controls.
    """
    shown = printable(line)
    if ":" not in shown and "#" not in shown:
        return shown
    return _COMMAND.sub(REPLACED, _AT_START.sub(rf"\1{REPLACED}", shown, count=1) if _AT_START.match(shown) else shown)


def escaped(text: str, escape: Callable[[str], str]) -> str:
    """Lines of a data format, in which `escape` writes what `harmless` would take away: the data stay what they are."""
    return "\n".join(_escaped(line, escape) for line in text.split("\n"))


def _escaped(line: str, escape: Callable[[str], str]) -> str:
    shown = harmless(line)
    if shown == line:
        return line
    return "".join(char if char == kept else escape(char) for char, kept in zip(line, shown, strict=True))
