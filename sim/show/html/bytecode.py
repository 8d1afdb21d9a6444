"""Bytecode of the templates: compiled once on a machine and read from then on, as Python does with its modules.

A template takes as long to compile as to import a dozen modules: of a run of a small program one tenth. Its bytecode
stands where Python would put that of a module beside it (``__pycache__``, or ``PYTHONPYCACHEPREFIX``). Bytecode that is
missing, damaged or of another text, Python or jinja2 counts as none; where it cannot be written, a template is compiled
in each process.
"""

import contextlib
import hashlib
import importlib.util
import marshal
import sys
from functools import cache
from pathlib import Path
from typing import Final

from jinja2 import BytecodeCache, compiler
from jinja2.bccache import Bucket

_SEAL: Final = hashlib.sha256().digest_size


class Bytecode(BytecodeCache):
    """What jinja2 asks for the bytecode of a template, and gives it to."""

    def get_cache_key(self, name: str, filename: str | None = None) -> str:
        """File of a template's bytecode; `name` where the template has no file."""
        return importlib.util.cache_from_source(filename or name)

    def load_bytecode(self, bucket: Bucket) -> None:
        """Give a bucket the bytecode of its template, where that is there and whole."""
        with contextlib.suppress(OSError):
            entry = Path(bucket.key).read_bytes()
            seal, code = entry[:_SEAL], entry[_SEAL:]
            if seal == _seal(bucket, code):
                bucket.code = marshal.loads(code)  # noqa: S302 - sealed, and as near to the package as its modules

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Write the bytecode of a template whole, where that can be done: another process may read it meanwhile."""
        if sys.dont_write_bytecode:
            return
        from controller.compiled.entries import write_whole  # noqa: PLC0415 - needed once on a machine

        code = marshal.dumps(bucket.code)
        path = Path(bucket.key)
        with contextlib.suppress(OSError):
            path.parent.mkdir(parents=True, exist_ok=True)
            write_whole(path, _seal(bucket, code) + code)


def _seal(bucket: Bucket, code: bytes) -> bytes:
    """Of a template's text, what compiled it, and its bytecode."""
    return hashlib.sha256(b" ".join((bucket.checksum.encode(), _compiler(), code))).digest()


@cache
def _compiler() -> bytes:
    """Jinja2's compiler as it is written, and Python's."""
    return Path(compiler.__file__).read_bytes() + sys.version.encode()
