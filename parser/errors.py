"""The family of errors drycut raises for bad input; each is one clear line for a person.

Every error doubles as the built-in that a caller without drycut's names would catch.
"""


class DrycutError(Exception):
    """Root of all errors that a user can cause; its text is the whole message."""


class FileUnreadableError(DrycutError, OSError):
    """A file that is missing, is a folder, or may not be read."""


class ProgramError(DrycutError, ValueError):
    """A program that cannot be dry-run at all: no text, no block, or numbers beyond any table.

    Parameters
    ----------
    message
        What was found; what was expected; what the machine would do.
    line, column
        Place in the program, both counted from 1; None where the whole file is meant.
    code
        Finding code of the catalogue, e.g. ``3B206``.
    excerpt
        The source line, shown with a caret under `column`.
    """

    def __init__(
        self, message: str, *, code: str, line: int | None = None, column: int | None = None, excerpt: str = ""
    ) -> None:
        super().__init__(message)
        self.code = code
        self.line = line
        self.column = column
        self.excerpt = excerpt


class SettingsError(DrycutError, ValueError):
    """A machine file, scenario file or option with an unknown key or a value out of bounds."""
