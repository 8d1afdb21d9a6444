"""What is no program is said by what it holds; a program is never taken for something else."""

import io
import zipfile
from pathlib import Path
from time import process_time

import pytest
from command import run_inside
from places import ROOT

from parser.drawing.read import read_drawing
from parser.files import HINTS, kind_of
from parser.findings.catalogue import LANGUAGES, term, texts
from parser.findings.errors import DrawingError, ProgramError
from parser.program import load_program

ISO = b"%\r\nO0001 (PART)\r\nN10 G90 G54\r\nN20 G00 X0 Y0\r\nN30 G41 D01\r\nN40 G01 X10.5 Y-.5 F12\r\nN50 M02\r\n%\r\n"
DXF = b"999\nmade by hand\n  0\r\nSECTION\r\n  2\r\nENTITIES\r\n  0\r\nENDSEC\r\n  0\r\nEOF\r\n"
SQUARE = "B9B0B9GXL1\nB0B9B9GYL2\nB9B0B9GXL3\nB0B9B9GYL4\nDD\n"


def _zipped(*names: str) -> bytes:
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w") as archive:
        for name in names:
            archive.writestr(zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0)), b"application/vnd.oasis.opendocument.text")
    return data.getvalue()


KINDS: dict[str, dict[str, bytes]] = {
    "kind-iso": {
        "of a wire EDM": ISO,
        "with remarks": b"; made by CAM\nG92 X0 Y0 (start)\nG42 H000\nG1 X5. Y2.\nG2 X1 Y1 I.5 J0\nM30\n",
        "glued": b"%\nN1G90G1X1Y1\nN2X2Y2\nM02\n",
    },
    "kind-dxf": {"text": DXF, "binary": b"AutoCAD Binary DXF\r\n\x1a\0\0SECTION\0"},
    "kind-dwg": {"R2018": b"AC1032\0\0\0\0\0\1", "R14": b"AC1014\0\0"},
    "kind-pdf": {"binary": b"%PDF-1.7\n%\xe2\xe3\xcf\xd3\n1 0 obj\0", "text": b"%PDF-1.4\n1 0 obj\n<< >>\n"},
    "kind-office": {
        "xlsx": _zipped("[Content_Types].xml", "xl/workbook.xml"),
        "odt": _zipped("mimetype"),
        "xls": b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1\0\0",
    },
    "kind-archive": {
        "zip": _zipped("part.3b"),
        "rar": b"Rar!\x1a\x07\0",
        "gzip": b"\x1f\x8b\x08\0\0",
        "7z": b"7z\xbc\xaf'\x1c\0",
    },
    "kind-picture": {
        "png": b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR",
        "jpeg": b"\xff\xd8\xff\xe0\0\x10JFIF\0",
        "bmp": b"BM\x36\0\x0c\0\0\0\0\0\x36\0",
    },
    "kind-svg": {"file": b'<?xml version="1.0"?>\n<!-- by a CAD -->\n<svg xmlns="http://www.w3.org/2000/svg"></svg>'},
    "kind-html": {
        "page": b"\n<!DOCTYPE html>\n<html><body>3B</body></html>",
        "bare": b"<HTML><BODY>login</BODY></HTML>",
    },
    "kind-executable": {"windows": b"MZ\x90\0\3\0\0\0", "linux": b"\x7fELF\2\1\1\0"},
    "kind-step": {"model": b"ISO-10303-21;\nHEADER;\nENDSEC;\n"},
    "kind-iges": {"model": b"made by CAD".ljust(72) + b"S      1\n" + b"1H,,1H;".ljust(72) + b"G      1\n"},
    "kind-curve-list": {"list": b"# plate\nkind,x1,y1,x2,y2\nline,0,0,9,9\n", "bare": b"CIRCLE;0;0;5\n"},
    "kind-hpgl": {
        "plot": b"IN;SP1;\nPU0,0;PD100,0;PD100,100;PU;SP0;\n",
        "with a lead": b"\x1b%-1BIN;SP1;PU0,0;PD9,9;",
        "coded": b"IN;SP1;PE<=\xbf\xbf\xc1\xc1;",
    },
    "kind-utf16": {"little": SQUARE.encode("utf-16-le"), "big": SQUARE.encode("utf-16-be")},
    "kind-toml": {"machine": (ROOT / "sim/setup/machine/dk7740.toml").read_bytes(), "few": b'a = 1\nb = "x"\n'},
    "kind-card-log": {"log": b"drycut card log 1\nsettings {}\n"},
}
DRAWN = {"kind-dxf", "kind-dwg", "kind-hpgl", "kind-svg", "kind-iges", "kind-curve-list"}
CASES = [(kind, name) for kind, several in KINDS.items() for name in several]


@pytest.mark.parametrize(("kind", "name"), [case for case in CASES if case[0] != "kind-iso"])
def test_what_is_no_program_is_said_in_both_languages_with_what_to_do(kind: str, name: str) -> None:
    data = KINDS[kind][name]
    with pytest.raises(ProgramError) as caught:
        load_program(data, "part.3b")
    finding = caught.value.finding
    assert (finding.code, finding.values["what"]) == ("3B100", kind)
    for language in LANGUAGES:
        said = texts(finding, language)
        assert said.found == term(kind, language)
        assert said.hint == term(HINTS.get(kind, "hint-program"), language)
        assert "`" not in said.found + said.hint, "no such term"


@pytest.mark.parametrize(("kind", "name"), [case for case in CASES if case[0] not in DRAWN])
def test_where_a_drawing_is_expected_it_is_said_what_came_instead(tmp_path: Path, kind: str, name: str) -> None:
    (tmp_path / "part.dxf").write_bytes(KINDS[kind][name])
    with pytest.raises(DrawingError) as caught:
        read_drawing(tmp_path / "part.dxf")
    assert f"is no DXF file ({term(kind)}); expected a drawing saved as DXF, a plot" in str(caught.value)


def test_a_program_is_no_drawing(tmp_path: Path) -> None:
    (tmp_path / "part.dxf").write_text(SQUARE)
    with pytest.raises(DrawingError, match=r"is no DXF file \(this is a 3B program\)"):
        read_drawing(tmp_path / "part.dxf")


@pytest.mark.parametrize(
    "before",
    [
        *(one for kind, name in CASES if kind != "kind-iso" and b"\0" not in (one := KINDS[kind][name])),
        b"(G01 X10 Y10)\n",
        b"; G01 X10 Y10\n%\n",
        b"%PDF-1.4 ist keins\n",
        b"Length = 36.0\nconnerR = 0\n",
    ],
)
def test_a_program_behind_anything_at_all_is_a_program(before: bytes) -> None:
    program = load_program(before + b"\n" + SQUARE.encode(), "part.3b")
    assert program.reading.counts.whole == 4


@pytest.mark.parametrize("before", KINDS["kind-iso"].values(), ids=KINDS["kind-iso"])
def test_programs_of_two_languages_in_one_file_are_none(before: bytes) -> None:
    with pytest.raises(ProgramError) as caught:
        load_program(before + SQUARE.encode(), "part.3b")
    assert (caught.value.finding.code, caught.value.finding.values["what"]) == ("ISO100", "two-languages")


@pytest.mark.parametrize("name", ["part.iso", "PART.NC", "part.cnc"])
def test_a_file_that_is_named_as_iso_is_told_that_it_is_no_iso_program(name: str) -> None:
    for data, what in ((b"", "empty"), (b"hello\n", "no-block"), (DXF, "kind-dxf"), (b"\0\1\2", "not-text")):
        with pytest.raises(ProgramError) as caught:
            load_program(data, name)
        assert (caught.value.finding.code, caught.value.finding.values["what"]) == ("ISO100", what)


@pytest.mark.parametrize(
    "data",
    [
        *(
            b"",
            b"\n \n",
            b"hello",
            b"0\n0\n0\n",
            b"GX1\nGY2\n",
            b"N10 X5\nN20 X6\n",
            b"Length=1.0\n",
            b"MZ is a text\n",
        ),
        *(b"BM is a text too\n", b"B10B0B10G1L1\nB10B0B10G1L3\n", b"%\n%\n", b"the PD of a G01; is a text\n"),
    ],
)
def test_what_may_be_anything_is_called_nothing(data: bytes) -> None:
    assert kind_of(data) == ""


@pytest.mark.parametrize(
    "data",
    [
        *(
            b"<!---->",
            b"<!--",
            b" ",
            b"0\n",
            b"0 SECTION\n",
            b"(",
            b"G",
            b"B ",
            b"B1",
            b"N1",
            b"PU;",
            b"PU",
            b"a.",
            b"[[",
        ),
        *(b"\r\n", b"X1 ", b"G0 X1\n", b"\x1b", b"0\nSECTION\n", b"{a=", b"a=[", b"S1"),
    ],
)
def test_hostile_bytes_are_looked_at_in_no_time(data: bytes) -> None:
    start = process_time()
    kind_of(data * (300_000 // len(data)))
    assert process_time() - start < 0.5


def test_a_check_names_what_it_was_given_and_what_to_do(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_bytes(DXF)
    done = run_inside("check", tmp_path / "part.3b")
    assert done.returncode == 2
    assert b"this is a DXF drawing" in done.stdout
    assert b"drycut compare PROGRAM DRAWING.dxf" in b" ".join(done.stdout.split())
    done = run_inside("run", tmp_path / "part.3b")
    assert done.returncode == 2
    assert b"error[3B100]: no 3B program\n" in done.stderr
    assert b" = found:    this is a DXF drawing" in done.stderr


def test_blocks_in_remarks_alone_are_no_program_and_nothing_else() -> None:
    with pytest.raises(ProgramError) as caught:
        load_program(b"; B9B0B9GXL1\n; B0B9B9GYL2\n", "part.3b")
    assert caught.value.finding.values["what"] == "no-block"
