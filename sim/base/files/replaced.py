"""A file of the user's with new content: whole or not at all, and with all else as it was."""

import errno
import os
import stat
import sys
from pathlib import Path

from parser.findings.errors import FileUnreadableError
from parser.findings.messages import system_message
from sim.base.files.stages import clear_once, stage_in


def replace_file(path: Path, before: bytes, after: bytes) -> None:
    """Put `after` in place of a file's content, whole or not at all, a power cut included; a link is followed.

    Owner, group, mode and, on Linux, extended attributes with access lists stay. Raises FileUnreadableError, and
    changes nothing, where they cannot, where the file is no longer as it was read (`before`), where it has a second
    name (a hard link), which would keep that content, where it is read-only, and where it or its folder cannot be
    written.
    """
    target = path.resolve()
    try:
        clear_once(target.parent)
        was = target.stat()
        _refuse(path, target, was)
        with stage_in(target.parent) as stage:
            made = stage / "mended"
            with os.fdopen(os.open(made, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as file:
                file.write(after)
                file.flush()
                os.fsync(file.fileno())  # else a power cut may leave an empty file under the name of a program
            _keep_owner(path, made, was)
            _keep_attributes(path, made, target)
            made.chmod(stat.S_IMODE(was.st_mode))
            if target.read_bytes() != before:
                raise FileUnreadableError("has-changed-since-read", path=path)
            made.replace(target)
    except FileUnreadableError:
        raise
    except OSError as error:
        raise FileUnreadableError("cannot-be-written", file=path, why=system_message(error)) from None


def _refuse(path: Path, target: Path, was: os.stat_result) -> None:
    """FileUnreadableError where a file may not be replaced."""
    if was.st_nlink > 1:
        raise FileUnreadableError("has-hard-links", path=path, names=was.st_nlink)
    # Root may write all files; one that nobody may write is still not meant to change.
    if not was.st_mode & 0o222 or not _may(target, os.W_OK):
        raise FileUnreadableError("is-read-only", path=path)
    if not _may(target.parent, os.W_OK | os.X_OK):
        raise FileUnreadableError("folder-takes-no-file", path=path)


def _may(path: Path, what: int) -> bool:
    return os.access(path, what, effective_ids=os.access in os.supports_effective_ids)


def _keep_owner(path: Path, made: Path, was: os.stat_result) -> None:
    """Give a file the owner and the group of another; FileUnreadableError where the system forbids it."""
    if sys.platform == "win32":
        return
    own = made.stat()
    try:
        if (own.st_uid, own.st_gid) != (was.st_uid, was.st_gid):
            os.chown(made, was.st_uid, was.st_gid)
    except OSError:
        raise FileUnreadableError("belongs-to-another-user", path=path) from None


def _keep_attributes(path: Path, made: Path, target: Path) -> None:
    """Give a file the extended attributes of another, among them its access list, and no more.

    FileUnreadableError where the system forbids it. Only Linux lets Python at them.
    """
    if sys.platform != "linux":
        return
    wanted, own = _attributes(target), _attributes(made)
    try:
        for name in own.keys() - wanted.keys():
            os.removexattr(made, name)
        for name, value in wanted.items():
            if own.get(name) != value:
                os.setxattr(made, name, value)
    except OSError as error:
        raise FileUnreadableError(
            "attributes-cannot-be-kept", path=path, names=", ".join(sorted(wanted)), why=system_message(error)
        ) from None


if sys.platform == "linux":

    def _attributes(path: Path) -> dict[str, bytes]:
        """Extended attributes by name; none where the file system has none."""
        try:
            return {name: os.getxattr(path, name) for name in os.listxattr(path)}
        except OSError as error:
            if error.errno == errno.ENOTSUP:
                return {}
            raise
