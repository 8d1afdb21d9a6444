"""Errors that drycut raises for bad input, and the messages that they hold: a code with its values.

The family of errors drycut raises for bad input; each is one clear line for a person.

Every error doubles as the built-in that a caller without drycut's names would catch.

What drycut says of wrong settings, files and options: a code with its values, in English and Chinese.

The texts stand in ``parser/findings/pages/messages.toml``, one code a line. A finding is something in a program; a
message is all else that a user may be told is wrong.
"""

import errno
from collections.abc import Callable, Iterable, Mapping
from types import MappingProxyType
from typing import Final

from parser.findings.catalogue import LANGUAGES, Bilingual, Language, filled, message_templates, texts
from parser.findings.findings import Finding

_OF_THE_SYSTEM: Final[Mapping[int, str]] = {
    errno.ENOENT: "no-such-file-or-directory",
    errno.EACCES: "permission-denied",
    errno.EISDIR: "is-a-directory",
    errno.ENOTDIR: "not-a-directory",
    errno.ENAMETOOLONG: "file-name-too-long",
    errno.ENOSPC: "no-space-left",
    errno.EROFS: "read-only-file-system",
    errno.ELOOP: "too-many-links",
}
_NUL: Final = "embedded null byte"
"""What Python says of a name that holds one."""


class Message(str):
    """A message by its code and values; as a ``str`` it is its English text, which libraries such as click take.

    Values are numbers, names that users gave, other messages, and texts in both languages (`Bilingual`). Only messages
    and such texts have another language: a name stays as it is. KeyError for a code without text, or a value that its
    text has a place for and that is missing.
    """

    __slots__ = ("code", "values")

    code: str
    values: Mapping[str, object]

    def __new__(cls, code: str, /, **values: object) -> "Message":
        """A message of a code."""
        made = super().__new__(cls, _text(code, values, "en"))
        made.code, made.values = code, MappingProxyType(values)
        return made

    def __reduce__(self) -> tuple[Callable[..., "Message"], tuple[str, dict[str, object]]]:
        """As other processes get it."""
        return _again, (self.code, dict(self.values))

    @property
    def en(self) -> str:
        """The English text."""
        return str(self)

    @property
    def zh(self) -> str:
        """The Chinese text."""
        return _text(self.code, self.values, "zh")

    def with_values(self, change: Callable[[object], object]) -> "Message":
        """The same with other values; messages among them are changed within."""
        return Message(
            self.code,
            **{
                name: value.with_values(change) if isinstance(value, Message) else change(value)
                for name, value in self.values.items()
            },
        )


def did_you_mean(name: str, known: Iterable[str], otherwise: Message, most: int = 1) -> Message:
    """The hint behind a name that is none: known ones that begin with it, or are like it; or what else helps."""
    import difflib  # noqa: PLC0415 - few names are misspelt

    by_capitals = {each.upper(): each for each in known}
    beginning = sorted(each for each in by_capitals if name and each.startswith(name.upper()))
    near = beginning[:most] or sorted(difflib.get_close_matches(name.upper(), by_capitals, n=most))
    names = ", ".join(by_capitals[each] for each in near)
    return Message("did-you-mean", name=names) if near else otherwise


def in_both(text: str) -> Bilingual:
    """A text in both languages; one that is no message, such as that of a library, is the same in both."""
    return Bilingual(text.en, text.zh) if isinstance(text, Message) else Bilingual(text, text)


def system_message(error: OSError | ValueError) -> str:
    """What the system says of a file; a message where it is one that users often see.

    ValueError is what Python raises of a name with a NUL.
    """
    code = _OF_THE_SYSTEM.get(getattr(error, "errno", None) or 0)
    if code is not None:
        return Message(code)
    why = str(getattr(error, "strerror", None) or error)
    return Message("embedded-null-byte") if why == _NUL else why


def _again(code: str, values: dict[str, object]) -> Message:
    return Message(code, **values)


def _text(code: str, values: Mapping[str, object], language: Language) -> str:
    return filled(getattr(message_templates()[code], language), values, language)


class DrycutError(Exception):
    """Root of all errors that a user can cause; its text is the whole message.

    Parameters
    ----------
    code, values
        Code of the message and what fills its places; or a message that there is already.
    """

    def __init__(self, code: str, /, **values: object) -> None:
        self.message = code if isinstance(code, Message) else Message(code, **values)
        super().__init__(self.message)

    def in_both(self) -> Bilingual:
        """The message in both languages."""
        return in_both(self.message)


class FileUnreadableError(DrycutError, OSError):
    """A file that is missing, may not be read, is no regular file, or is too large.

    Finding 3B100 says the same of a program: `what` is the term of the catalogue there, and `detail` says more.
    """

    @property
    def what(self) -> str:
        """The term of the catalogue that says why."""
        return str(self.message.values.get("what", "unreadable-file"))

    @property
    def detail(self) -> str:
        """What more there is to say, such as the words of the system; a message where there are such."""
        found = self.message.values.get("detail") or self.message.values.get("why", "")
        return found if isinstance(found, str) else str(found)


class ProgramError(DrycutError, ValueError):
    """A program that cannot be dry-run at all: no text, no block, or numbers beyond any table.

    Parameters
    ----------
    finding
        What is wrong; its English message is the text of the error.
    excerpt
        The source line that the finding points at, where it points at one.
    others
        What else was found before this ended the reading, in file order.
    """

    def __init__(self, finding: Finding, *, excerpt: str = "", others: tuple[Finding, ...] = ()) -> None:
        super().__init__(
            "of-a-finding", finding=Bilingual(*(texts(finding, language).message for language in LANGUAGES))
        )
        self.finding = finding
        self.excerpt = excerpt
        self.others = others


class SettingsError(DrycutError, ValueError):
    """A machine file, scenario file or option with an unknown key or a value out of bounds."""


class ControllerError(DrycutError, RuntimeError):
    """A controller that refuses what it is told to run."""


class DrawingError(DrycutError, ValueError):
    """A drawing that is no DXF, is damaged beyond mending, or holds no curve where curves were asked for."""


class ClusterError(DrycutError, ConnectionError):
    """Workers on other machines that cannot be reached, or that would make other files than this one."""
