"""A DWG is read where a converter is installed, and else it is said what to do."""

import os
from pathlib import Path

import pytest
from drawings_dxf import drawn

from parser.drawing.read import read_drawing
from parser.findings.errors import DrawingError

DWG = b"AC1032\0\0\0\0\0\1" + bytes(200)
CONVERTER = """#!/bin/sh
# Takes folder, folder, release, type, recurse, audit and file, as the converter does.
[ -n "{source}" ] && cp "{source}" "$2/$(basename "$7" .dwg).dxf"
exit 0
"""


@pytest.fixture(name="dwg")
def dwg_path(tmp_path: Path) -> Path:
    (tmp_path / "part.dwg").write_bytes(DWG)
    return tmp_path / "part.dwg"


def installed(folder: Path, source: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Puts a converter in reach that makes a copy of a file, or of none nothing."""
    program = folder / "ODAFileConverter"
    program.write_text(CONVERTER.format(source=source), "utf-8")
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{folder}{os.pathsep}{os.environ['PATH']}")


@pytest.mark.skipif(os.name != "posix", reason="the stand-in for the converter is a shell script")
def test_a_dwg_is_read_by_way_of_the_converter(dwg: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    made = drawn(tmp_path, lambda space: space.add_circle((3, 4), 5))
    installed(tmp_path, str(made), monkeypatch)
    drawing = read_drawing(dwg)
    assert drawing.name == "part.dwg"
    assert drawing.curves.radius_um.tolist() == [5000.0]


@pytest.mark.skipif(os.name != "posix", reason="the stand-in for the converter is a shell script")
def test_a_converter_that_makes_nothing_is_told(dwg: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    installed(tmp_path, "", monkeypatch)
    with pytest.raises(DrawingError, match="made nothing"):
        read_drawing(dwg)


def test_without_a_converter_it_is_said_what_to_do(dwg: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(DrawingError, match="save it as DXF, or install"):
        read_drawing(dwg)
