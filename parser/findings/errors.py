"""The family of errors drycut raises for bad input; each is one clear line for a person.

Every error doubles as the built-in that a caller without drycut's names would catch.
"""

from parser.findings.catalogue import LANGUAGES, Bilingual, texts
from parser.findings.findings import Finding
from parser.findings.messages import Message, in_both


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
