"""Program files in the encodings that Chinese CAMs write, and files that are no text at all."""

import random
import tomllib
from pathlib import Path

import pytest
from places import ROOT

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


GLOSSARY = tomllib.loads((ROOT / "docs" / "glossary.toml").read_text("utf-8"))
COMMON = "".join(bytes([row, cell]).decode("gbk") for row in range(0xB0, 0xD6, 3) for cell in range(0xA1, 0xFE, 2))


def read_back(remark: str, codec: str) -> str:
    return decode_text(f"B0B24900B24900GYL2 //{remark} 1.3B\nDD\n".encode(codec))[0].splitlines()[0].partition("//")[2]


@pytest.mark.parametrize("codec", ["utf-8", "gbk"])
def test_words_of_the_trade_and_common_characters_side_by_side_are_read_in_either_encoding(codec: str) -> None:
    rng = random.Random(7)
    words = ["凸模", *(entry["zh"] for part in GLOSSARY.values() for entry in part.values() if "zh" in entry)]
    pairs = ["".join(rng.sample(COMMON, 2)) for _ in range(2000)]
    written = [word for word in words + pairs if word.encode(codec, "ignore").decode(codec) == word]
    assert len(written) > 2000
    assert [word for word in written if read_back(word, codec) != f"{word} 1.3B"] == []


@pytest.mark.parametrize("remark", ["±0.01 µm 90°", "Pièce für Größe é", "Ø20 ×2", "план деталь корпус", "Διάσταση"])
def test_remarks_of_the_west_stay_what_they_are(remark: str) -> None:
    assert decode_text(f"B1 //{remark}\nDD\n".encode()) == (f"B1 //{remark}\nDD\n", "utf-8")


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
