"""Names of files that come from a page."""

import re
from pathlib import Path
from typing import Final

_UNSAFE: Final = re.compile(r"[^\w.-]")
_LONGEST: Final = 60


def safe_name(name: str) -> str:
    """A name for a file that nothing in it makes a way to another one, nor an option."""
    return _UNSAFE.sub("_", Path(name).name)[-_LONGEST:].lstrip(".-") or "program"
