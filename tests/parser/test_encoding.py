"""Program files in the encodings that Chinese CAMs write, and files that are no text at all."""

from pathlib import Path

import pytest

from parser.findings.errors import DrycutError, FileUnreadableError, ProgramError
from parser.program import read_program
from parser.text.encoding import decode_text

BLOCK = "N1: B0 B24900 B24900 GYL2;0.000,24.900//往Y軸正向移動24.9 mm;\r\nDD//结束停机\r\n"


@pytest.mark.parametrize(
    ("codec", "named"),
    [
        ("utf-8", "utf-8"),
        ("utf-8-sig", "utf-8-sig"),
        ("gbk", "gb18030"),
        ("utf-16", "utf-16-le"),
        ("gb18030", "gb18030"),
    ],
)
def test_remarks_survive_their_encoding(codec: str, named: str) -> None:
    assert decode_text(BLOCK.encode(codec)) == (BLOCK, named)


def test_big5_remarks_leave_the_blocks_readable(tmp_path: Path) -> None:
    path = tmp_path / "零件.3B"
    path.write_bytes("B0B24900B24900GYL2 //往Y軸正向移動\nDD".encode("big5"))
    program = read_program(path)
    assert len(program.toolpath) == 1
    assert program.findings == ()


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b" \r\n\t",
        b"\xff\xfe",
        b"\xef\xbb\xbf",
        b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR",
        b"PK\x03\x04",
        b"\xff\xfeB",
        bytes(range(256)),
    ],
)
def test_what_is_no_text_is_refused(data: bytes) -> None:
    with pytest.raises(ProgramError) as caught:
        decode_text(data)
    assert caught.value.finding.code == "3B100"


def test_missing_file_and_folder_are_refused(tmp_path: Path) -> None:
    for path in (tmp_path, tmp_path / "missing.3b"):
        with pytest.raises(FileUnreadableError, match=path.name):
            read_program(path)


def test_errors_double_as_builtins() -> None:
    assert issubclass(FileUnreadableError, OSError)
    assert issubclass(ProgramError, ValueError)
    assert issubclass(ProgramError, DrycutError)
