"""The packing for Windows: what a bundle does that is started, and that its installer takes away what it wrote."""

import os
import re
import runpy
import shutil
import subprocess
import time
from pathlib import Path

import pytest
from places import ROOT

FOLDER = ROOT / "docs" / "windows"
ENTRY = runpy.run_path(str(FOLDER / "entry.py"))
SETUP = (FOLDER / "setup.nsi").read_text("utf-8")


@pytest.mark.parametrize(
    ("program", "arguments", "wanted"),
    [
        ("C:\\x\\drycut.exe", ["check", "a.3b"], ["check", "a.3b"]),
        ("C:\\x\\drycut-page.exe", [], ["open", "--from-icon"]),
        ("C:\\x\\Drycut-Page.exe", ["D:\\零件 1.3b"], ["open", "--from-icon", "D:\\零件 1.3b"]),
        ("/opt/drycut/drycut-page", ["a.3b"], ["open", "--from-icon", "a.3b"]),
    ],
)
def test_a_program_of_the_bundle_begins_as_its_name_says(program: str, arguments: list[str], wanted: list[str]) -> None:
    assert ENTRY["arguments_of"](program, arguments) == wanted


@pytest.mark.parametrize(
    ("arguments", "wanted"),
    [
        (["-P", "-m", "sim.serve.page.runner", "--ahead"], ("sim.serve.page.runner", ["--ahead"])),
        (["-m", "sim.cli.compile"], ("sim.cli.compile", [])),
        (["check", "-m"], None),
        (["-m"], None),
        ([], None),
    ],
)
def test_a_bundle_runs_modules_as_a_python_would(arguments: list[str], wanted: object) -> None:
    assert ENTRY["module_of"](arguments) == wanted


def test_the_command_that_starts_processes_of_the_page_is_one_that_a_bundle_answers() -> None:
    from sim.serve.page import child

    found = re.search(r"command = \(sys\.executable, (.*?), module", Path(child.__file__).read_text("utf-8"))
    assert found
    options = re.findall(r'"([^"]+)"', found[1])
    assert ENTRY["module_of"]([*options, "x"]) == ("x", [])


def test_the_page_has_no_window_of_a_terminal() -> None:
    spec = (FOLDER / "drycut.spec").read_text("utf-8")

    assert re.search(r'name="drycut-page", console=False', spec)
    assert re.search(r'name="drycut", console=True', spec)


def test_the_installer_needs_no_rights_and_takes_away_all_that_it_writes() -> None:
    install, uninstall = SETUP.split('Section "Uninstall"')
    assert "RequestExecutionLevel user" in install
    assert not re.search(r"\bHK(?:LM|CR|EY_LOCAL_MACHINE)\b", SETUP)
    for key in set(re.findall(r'WriteRegStr HKCU "([^"]+)"', install)):
        gone = rf'DeleteReg(?:Key|Value)(?: /ifempty)? HKCU "{re.escape(key)}"'
        above = re.escape(key.split("\\shell")[0].split("\\DefaultIcon")[0])
        assert re.search(gone, uninstall) or re.search(rf'DeleteRegKey HKCU "{above}"', uninstall), key
    for link in re.findall(r'CreateShortcut "([^"]+)"', install):
        assert f'Delete "{link}"' in uninstall
    assert not re.search(r'RMDir /r "\$INSTDIR"', uninstall)  # somebody may have put files of his own there
    for language in ("SimpChinese", "English"):
        assert f'MUI_LANGUAGE "{language}"' in install


@pytest.mark.deeper
def test_the_installer_installs_and_uninstalls(tmp_path: Path) -> None:
    makensis, started, server = (shutil.which(name) for name in ("makensis", "wine", "wineserver"))
    if not makensis or not started or not server:
        pytest.skip("there is no makensis, or no wine")
    bundle, setup = tmp_path / "bundle", tmp_path / "drycut-0-setup.exe"
    (bundle / "_internal").mkdir(parents=True)
    for name in ("drycut.exe", "drycut-page.exe", "_internal/a"):
        (bundle / name).write_text("x", "utf-8")
    made = [
        "makensis",
        "-V2",
        "-WX",
        "-DVERSION=0",
        f"-DBUNDLE={bundle}",
        f"-DOUTPUT={setup}",
        str(FOLDER / "setup.nsi"),
    ]
    subprocess.run(made, check=True, timeout=100)
    prefix = tmp_path / "wine"
    environment = {**os.environ, "WINEPREFIX": str(prefix), "WINEDEBUG": "-all", "DISPLAY": ""}

    def wine(*arguments: str) -> str:
        done = subprocess.run(
            [started, *arguments], env=environment, capture_output=True, text=True, timeout=150, check=False
        )
        return done.stdout

    try:
        wine(str(setup), "/S")
        (program,) = prefix.rglob("drycut-page.exe")
        assert "drycut-page.exe" in wine("reg", "query", r"HKCU\Software\Classes\drycut.program\shell\open\command")
        assert "drycut.program" in wine("reg", "query", r"HKCU\Software\Classes\.3b")
        own = program.with_name("mine.3b")
        own.write_text("x", "utf-8")
        wine(str(program.with_name("uninstall.exe")), "/S")
        ends_s = time.monotonic() + 60.0  # it goes on by itself, from a copy
        while {path.name for path in program.parent.iterdir()} != {"mine.3b"}:
            assert time.monotonic() < ends_s
            time.sleep(0.2)
        assert own.exists()
        assert "drycut" not in wine("reg", "query", r"HKCU\Software\Classes", "/s")
    finally:
        subprocess.run([server, "-k"], env=environment, check=False, timeout=60)
