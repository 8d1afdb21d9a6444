"""What starts the page without a terminal: a desktop entry with its icon on Linux, a script on Windows.

Either passes the file or folder that is dropped on it, whatever its name is, to this very installation of drycut.
"""

import sys
from pathlib import Path
from typing import Final

from parser.findings.errors import SettingsError
from sim.base.files import staged
from sim.show.texts.texts import bilingual

OPTION: Final = "--from-icon"
"""Of `drycut open`, with which both of them start it."""
_START: Final = ("-P", "-m", "drycut", "open", OPTION)
"""For Python: nothing is imported from the folder that a desktop happens to start it in."""
_ENTRY, _SCRIPT, _PICTURE = "drycut.desktop", "drycut.vbs", "drycut.svg"
_ICON: Final = Path(__file__).with_name("icon.svg")
# What a shell would take for its own between double quotes (Desktop Entry Specification, "The Exec key").
_QUOTED: Final = '"`$\\'


def write_shortcut(folder: Path, platform: str = sys.platform) -> list[Path]:
    """Write it for a platform of `sys.platform`, in place of an earlier one; the files written.

    SettingsError where there is none for it, FileUnreadableError where the folder cannot be written.
    """
    folder = folder.absolute()
    if platform == "win32":
        files = {_SCRIPT: b"\xff\xfe" + windows_script(_windowless(Path(sys.executable))).encode("utf-16-le")}
    elif platform == "linux":
        entry = desktop_entry(Path(sys.executable), folder / _PICTURE)
        files = {_ENTRY: entry.encode(), _PICTURE: _ICON.read_bytes()}
    else:
        raise SettingsError("no-shortcut-here", system=platform)
    with staged(folder, list(files)) as stage:
        for name, data in files.items():
            (stage / name).write_bytes(data)
        if _ENTRY in files:
            (stage / _ENTRY).chmod(0o755)  # desktops start no entry that lies on them and may not be executed
    return [folder / name for name in files]


def desktop_entry(python: Path, icon: Path) -> str:
    """A desktop entry that starts drycut with a Python (https://specifications.freedesktop.org/desktop-entry-spec)."""
    comment = bilingual("open.shortcut")
    command = " ".join(_argument(part) for part in (str(python), *_START))
    keys = {
        "Type": "Application",
        "Version": "1.5",
        "Name": "drycut",
        "Comment": comment.en,
        "Comment[zh_CN]": comment.zh,
        "Exec": f"{_value(command)} %f",  # %f is one argument, whatever the name is
        "Icon": _value(str(icon)),
        "Terminal": "false",
        "Categories": "Science;Engineering;",
    }
    return "[Desktop Entry]\n" + "".join(f"{key}={value}\n" for key, value in keys.items())


def windows_script(python: Path) -> str:
    """A script for the Windows Script Host that starts drycut with a Python that has no console.

    Names reach it whole, no shell is asked, and nothing in them is expanded. A backslash at the end, as drives have
    one, would make a letter of the closing quote: it is doubled.
    """
    lines = (
        "Option Explicit",
        "Dim path, options",
        f'options = "{" ".join(_START)}"',
        "If WScript.Arguments.Count > 0 Then",
        "  path = WScript.Arguments(0)",
        '  If Right(path, 1) = "\\" Then path = path & "\\"',
        '  options = options & " """ & path & """"',
        "End If",
        f'CreateObject("Shell.Application").ShellExecute "{python}", options, "", "open", 1',
    )
    return "".join(f"{line}\r\n" for line in lines)


def _windowless(python: Path) -> Path:
    """The Python beside it that opens no console, where there is one."""
    quiet = python.with_name("pythonw.exe")
    return quiet if quiet.exists() else python


def _argument(text: str) -> str:
    """An argument of the Exec key, in quotes; a percent sign is no field."""
    escaped = "".join(f"\\{letter}" if letter in _QUOTED else letter for letter in text)
    return f'"{escaped}"'.replace("%", "%%")


def _value(text: str) -> str:
    """A text as the value of a key: there a backslash begins an escape."""
    return text.replace("\\", "\\\\").replace("\n", "\\n").replace("\t", "\\t")
