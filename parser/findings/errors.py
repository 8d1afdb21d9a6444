"""The family of errors drycut raises for bad input; each is one clear line for a person.

Every error doubles as the built-in that a caller without drycut's names would catch.
"""

from parser.findings.catalogue import texts
from parser.findings.findings import Finding


class DrycutError(Exception):
    """Root of all errors that a user can cause; its text is the whole message."""


class FileUnreadableError(DrycutError, OSError):
    """A file that is missing, may not be read, is no regular file, or is too large.

    Parameters
    ----------
    text
        The whole message.
    what, detail
        Values of finding 3B100: a term of the catalogue that says why, and more to it.
    """

    def __init__(self, text: str, *, what: str = "unreadable-file", detail: str = "") -> None:
        super().__init__(text)
        self.what = what
        self.detail = detail


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
        super().__init__(texts(finding).message)
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
