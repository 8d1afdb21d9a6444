"""What starts the page without a terminal: names with any letters reach drycut whole, and what fails is on the page."""

import configparser
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest
from command import run_command
from opened_page import opened_page
from places import ROOT

from parser.findings.errors import FileUnreadableError, SettingsError
from sim.cli.open import _programs
from sim.serve.page.shortcut import desktop_entry, windows_script, write_shortcut

NAMES = ("part.3b", "two words.3b", "a&b;c.3b", "孔 圆.3b", "50%f %TEMP%.3b", "a'b\"c`d$HOME\\e.3b", "-o.3b", "")
PYTHONS = ("/usr/bin/python3", '/home/王 明/my "env"/100% $x`\\/bin/python')


def keys_of(entry: str) -> dict[str, str]:
    """The keys of a desktop entry."""
    read = configparser.RawConfigParser(delimiters=("=",), strict=True)
    read.optionxform = str  # type: ignore[assignment,method-assign]  # case counts
    read.read_string(entry)
    assert read.sections() == ["Desktop Entry"]
    return dict(read["Desktop Entry"])


def unescaped(value: str) -> str:
    """A value of a key as it is meant."""
    letters = {"\\": "\\", "n": "\n", "t": "\t", "s": " ", "r": "\r"}
    parts, at = [], 0
    while at < len(value):
        if value[at] == "\\":
            at += 1
            parts.append(letters[value[at]])
        else:
            parts.append(value[at])
        at += 1
    return "".join(parts)


def started(exec_key: str, file: str) -> list[str]:
    """The arguments that an Exec key starts a program with: quoted there as for a shell, so a shell is asked."""
    fields = unescaped(exec_key).replace("%%", "\0").replace("%f", '"$1"').replace("\0", "%")
    show = ["/bin/sh", "-c", f"printf '%s\\0' {fields}", "sh", file]
    return subprocess.run(show, capture_output=True, check=True).stdout.decode().split("\0")[:-1]


@pytest.mark.skipif(not Path("/bin/sh").exists(), reason="asks a shell")
@pytest.mark.parametrize("python", PYTHONS)
@pytest.mark.parametrize("name", NAMES)
def test_an_entry_starts_this_python_with_the_file_whatever_both_are_called(python: str, name: str) -> None:
    exec_key = keys_of(desktop_entry(Path(python), Path("/icon.svg")))["Exec"]
    assert started(exec_key, name) == [python, "-P", "-m", "drycut", "open", "--from-icon", name]


def test_an_entry_has_the_keys_that_desktops_ask_for(tmp_path: Path) -> None:
    written = write_shortcut(tmp_path / "孔 b", "linux")
    assert [file.name for file in written] == ["drycut.desktop", "drycut.svg"]
    entry = written[0].read_text("utf-8")
    assert entry.startswith("[Desktop Entry]\n")
    keys = keys_of(entry)
    assert (keys["Type"], keys["Terminal"], keys["Name"]) == ("Application", "false", "drycut")
    assert keys["Comment"] != keys["Comment[zh_CN]"]
    assert keys["Categories"].endswith(";")
    assert keys["Exec"].count("%f") == 1
    assert '"%f' not in keys["Exec"], "a field stands outside of quotes"
    assert unescaped(keys["Icon"]) == str(written[1])
    assert written[1].read_text("utf-8").startswith("<svg ")
    assert os.access(written[0], os.X_OK)
    if validate := shutil.which("desktop-file-validate"):
        subprocess.run([validate, str(written[0])], check=True)
    assert write_shortcut(tmp_path / "孔 b", "linux") == written, "an earlier one is replaced"


def test_the_script_for_windows_passes_names_to_no_shell(tmp_path: Path) -> None:
    (file,) = write_shortcut(tmp_path, "win32")
    assert file.name == "drycut.vbs"
    text = file.read_bytes().decode("utf-16")
    assert str(Path(sys.executable)) in text
    script = windows_script(Path(r"C:\王 明\pythonw.exe"))
    assert script.encode("utf-16-le").decode("utf-16-le") == script
    lines = script.split("\r\n")
    assert lines[-2] == (
        r'CreateObject("Shell.Application").ShellExecute "C:\王 明\pythonw.exe", options, "", "open", 1'
    )
    assert r'  options = options & " """ & path & """"' in lines, "in quotes, for spaces"
    assert all(word not in script.lower() for word in ("cmd", ".run", ".exec ", "%"))


def test_python_without_a_console_is_taken_where_there_is_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "executable", str(tmp_path / "python.exe"))
    (tmp_path / "pythonw.exe").touch()
    (file,) = write_shortcut(tmp_path, "win32")
    assert str(tmp_path / "pythonw.exe") in file.read_bytes().decode("utf-16")


def test_other_systems_are_told_so(tmp_path: Path) -> None:
    with pytest.raises(SettingsError, match="for Linux and Windows, not for darwin"):
        write_shortcut(tmp_path, "darwin")


@pytest.mark.skipif(sys.platform != "linux", reason="what is written for this system")
def test_the_command_writes_it_and_ends(tmp_path: Path) -> None:
    done = run_command("open", "--shortcut", str(tmp_path / "new"))
    assert done.returncode == 0
    assert done.stdout.decode().startswith(f"written: {tmp_path}/new/drycut.desktop")
    assert sorted(file.name for file in (tmp_path / "new").iterdir()) == ["drycut.desktop", "drycut.svg"]


@pytest.mark.deeper
def test_what_cannot_be_opened_from_an_icon_is_said_on_the_page(tmp_path: Path) -> None:
    with opened_page(tmp_path / "gone.3b", "--from-icon") as served:
        first = json.loads(served.ask("first").body)
        assert first["text"] == ""
        assert "gone.3b: cannot be read" in first["why"]["en"]
    assert "no program there" in _programs(tmp_path, from_icon=True).opened.why.en
    with pytest.raises(FileUnreadableError):
        _programs(tmp_path, from_icon=False)


@pytest.mark.deeper
@pytest.mark.skipif(not Path("/bin/sh").exists(), reason="closes what a terminal would be")
def test_it_runs_where_there_is_no_terminal_at_all() -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = f'exec "{sys.executable}" -m drycut open --from-icon --no-browser --port {port} <&- >&- 2>&-'
    process = subprocess.Popen(["/bin/sh", "-c", command], cwd=ROOT)
    try:
        for _ in range(400):
            with socket.socket() as link:
                if link.connect_ex(("127.0.0.1", port)) == 0:
                    break
            time.sleep(0.05)
        else:
            raise AssertionError("it does not listen")
        process.send_signal(signal.SIGTERM)
        assert process.wait(30.0) == 0
    finally:
        process.kill()
        process.wait()
