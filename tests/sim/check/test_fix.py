"""``drycut check --fix`` mends what is certain, and nothing else in the file changes."""

import os
import stat
from pathlib import Path

import pytest
from checking import SOUND, drycut
from click.testing import CliRunner

from parser.findings.errors import FileUnreadableError
from sim.base.files import replace_file
from sim.cli.check.command import check

PRINTED = (
    "N1: B0 B24900 B24900 GYL2;0.000,24.900//起点\r\n"
    "N2: B 0 B 24900 B 49800 GX NR2;-0.000,-24.900\r\n"
    "N3: B 56757 B 0 B 56757 GX L1;56.757,-24.900\r\n"
    "N4: B 43243 B 24900 B 149800 GY NR3;56.756,24.898\r\n"
    "N5: B 56756 B 2 B 56756 GX L2;0.000,24.900\r\n"
    "N6: B 0 B 24900 B 24900 GY L4;0.000,0.000\r\n"
    "N7: DD//停机\r\n"
)


def fixed(path: Path, data: bytes) -> tuple[bytes, str]:
    path.write_bytes(data)
    _, _, err = drycut("check", path, "--fix")
    return path.read_bytes(), err


@pytest.mark.alike(6)
@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("GX L1;", "GX L4;"),  # the neighbour's label on an axis
        ("B 49800 GX", "B 4980 GX"),  # J, by the printed end
        ("B 56757 GX", "B 56575 GX"),
        ("B 149800 GY NR3", "B 149800 GX NR3"),  # the axis, by the printed end
    ],
)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "gb18030", "utf-16"])
def test_what_is_certain_is_mended_and_the_rest_kept_byte_for_byte(
    tmp_path: Path, right: str, wrong: str, encoding: str
) -> None:
    sound = PRINTED.encode(encoding)
    mended, told = fixed(tmp_path / "part.3b", PRINTED.replace(right, wrong).encode(encoding))
    assert mended == sound
    assert wrong in told
    assert right in told


def test_a_count_axis_is_mended_with_the_count_that_keeps_the_path(tmp_path: Path) -> None:
    circle = "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD"
    mended, _ = fixed(tmp_path / "a.3b", circle.replace("GYNR1", "GXNR1").encode())
    assert mended == circle.encode()
    # A quarter and a bit: its end lies near the X axis on the left, where X stands still.
    arc = "B10000B0B{j}G{g}NR1;-9.700,2.431\nDD"
    mended, _ = fixed(tmp_path / "b.3b", b"Start Point = 10.0, 0.0\n" + arc.format(j=19700, g="X").encode())
    assert mended.partition(b"\n")[2] == arc.format(j=17569, g="Y").encode()


ARC = "B10000B0B19990GXNR1"


@pytest.mark.parametrize(
    "text",
    [
        pytest.param(f"B0B10000B10000GYL2\n{ARC}\nDD", id="a cut that need not close"),
        pytest.param(f"{ARC}\nB0B10000B10000GYL4\nB10000B10GXL1\nDD", id="a damaged block in the contour"),
        pytest.param(f"{ARC}\nB10000B0B10000GXL1\nDD", id="an open contour"),
    ],
)
@pytest.mark.parametrize("option", [(), ("--ignore", "3B301"), ("--select", "3B204")])
def test_a_count_axis_is_left_where_nothing_proves_the_end(tmp_path: Path, text: str, option: tuple[str, ...]) -> None:
    path = tmp_path / "part.3b"
    path.write_text(text, "ascii")
    _, _, told = drycut("check", path, "--fix", *option)
    assert path.read_text("ascii") == text
    assert "3B204 is left as it is; more than one mend is possible" in told


def test_a_full_circle_on_the_wrong_axis_proves_itself(tmp_path: Path) -> None:
    text = "B9900B0B9900GXL1\nB9900B0B39600G{}NR1\nB9900B09900GXL3\nDD"
    assert fixed(tmp_path / "part.3b", text.format("X").encode())[0] == text.format("Y").encode()


def test_a_label_is_mended_to_the_one_that_also_closes_the_contour(tmp_path: Path) -> None:
    # L3 mistyped as L4 decodes as L1, and the rule alone would have it L1.
    text = "B0B10000B10000GYL2\nB10000B0B10000GXL1\nB0B10000B10000GYL4\nB10000B0B10000GXL4\nDD"
    data, _ = fixed(tmp_path / "part.3b", text.encode())
    assert data == text.replace("GXL4", "GXL3").encode()


def test_a_label_is_left_where_it_may_be_a_slip_of_either_sense(tmp_path: Path) -> None:
    # A half circle between corners: NR3 from −Y is a slip of NR4, or of SR3.
    text = (
        "B0B12000B12000GYL4\nB10000B0B10000GXL1\nB0B4000B4000GYL2\n"
        "B0B2000B4000GXNR3\nB0B4000B4000GYL2\nB10000B0B10000GXL3\nDD\n"
    )
    data, told = fixed(tmp_path / "part.3b", text.encode())
    assert data == text.encode()
    assert "3B203 is left as it is; more than one mend is possible:\n    block 4 with NR4 or block 4 with SR3" in told


@pytest.mark.parametrize(
    "text",
    [
        "N1:B9900B0B9900GXL1;9.900,0.000\nN2:B9900B0B19800GYNR1;-9.900,0.005\n"
        "N3:B9900B0B19800GYNR3;9.900,0.000\nN4:B9900B0B9900GXL3;0.000,0.000\nDD",
        "B0B10000B10000GYL2;0.000,10.000\nB10000B0B10000GXL1;10.000,10.003\n"
        "B0B10000B10000GYL4;10.000,0.000\nB10000B0B10000GXL3;0.000,0.000\nDD",
        "B0B10004B10004GYL2;0.00,10.00\nB10004B0B10004GXL1;10.00,10.00\n"
        "B0B10004B10004GYL4;10.00,0.00\nB10004B0B10004GXL3;0.00,0.00\nDD",
    ],
)
def test_a_wrong_printed_end_never_changes_a_right_block(tmp_path: Path, text: str) -> None:
    assert fixed(tmp_path / "part.3b", text.encode()) == (text.encode(), "")


@pytest.mark.parametrize(
    ("text", "mended"),
    [
        ("B1B0B1GXL1\nB1B0B1GXL3\n", "B1B0B1GXL1\nB1B0B1GXL3\nDD\n"),
        ("B1B0B1GXL1\rB1B0B1GXL3", "B1B0B1GXL1\rB1B0B1GXL3\rDD"),
        ("B1B0B1GXL1B1B0B1GXL3", "B1B0B1GXL1B1B0B1GXL3\nDD"),
        ("B1B0B1GXL1\r\nB1B0B1GXL3 //x\r\n\x1a", "B1B0B1GXL1\r\nB1B0B1GXL3 //x\r\nDD\r\n\x1a"),
    ],
)
def test_a_missing_end_code_is_added_with_the_line_ends_of_the_file(tmp_path: Path, text: str, mended: str) -> None:
    assert fixed(tmp_path / "part.3b", text.encode())[0] == mended.encode()


@pytest.mark.parametrize("tail", ["B9900B0B99", "B9900B0B9900GX", "DDX", "B0B", "D\nnext part"])
def test_no_end_code_is_added_behind_what_cannot_be_read(tmp_path: Path, tail: str) -> None:
    text = f"B1B0B1GXL1\nB1B0B1GXL3\n{tail}\n"
    assert fixed(tmp_path / "part.3b", text.encode())[0] == text.encode()


def test_an_end_code_is_added_where_only_an_earlier_block_is_damaged(tmp_path: Path) -> None:
    text = "B1B0B1GX\nB1B0B1GXL3\n"
    assert fixed(tmp_path / "part.3b", text.encode())[0] == f"{text}DD\n".encode()


def test_a_sound_file_is_not_touched(tmp_path: Path) -> None:
    path = tmp_path / "part.3b"
    path.write_text(SOUND, "ascii")
    os.utime(path, (1e9, 1e9))
    code, _, err = drycut("check", path, "--fix")
    assert (code, err, path.stat().st_mtime) == (0, "", 1e9)


def test_two_possible_mends_change_nothing_and_are_told(tmp_path: Path) -> None:
    # Either of the two sides along X may be the one that should run back.
    text = "B10000B0B10000GXL1\nB0B10000B10000GYL2\nB10000B0B10000GXL1\nB0B10000B10000GYL4\nDD\n"
    data, told = fixed(tmp_path / "part.3b", text.encode())
    assert data == text.encode()
    assert "3B301 is left as it is; more than one mend is possible:\n    block" in told


def test_ignored_findings_are_not_mended(tmp_path: Path) -> None:
    path = tmp_path / "part.3b"
    path.write_text(SOUND.replace("GXL1", "GXL4").replace("DD\n", ""), "ascii")
    drycut("check", path, "--fix", "--select", "3B203")
    assert path.read_text() == SOUND.replace("DD\n", "")


def test_files_behind_one_that_cannot_be_written_are_mended(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    wrong = SOUND.replace("GXL1", "GXL4")
    first, second = tmp_path / "a.3b", tmp_path / "b.3b"
    for path in (first, second):
        path.write_text(wrong, "ascii")

    def refused(path: Path, before: bytes, after: bytes) -> None:
        if path == first:
            raise FileUnreadableError("is-read-only", path=path)
        replace_file(path, before, after)

    monkeypatch.setattr("sim.cli.check.mends.replace_file", refused)
    done = CliRunner().invoke(check, [str(tmp_path), "--fix"])
    assert done.exit_code == 2
    assert "a.3b: cannot be written" in done.output
    assert (first.read_text(), second.read_text()) == (wrong, SOUND)


def test_permissions_and_links_stay(tmp_path: Path) -> None:
    path, link = tmp_path / "part.3b", tmp_path / "link.3b"
    path.write_text(SOUND.replace("GXL1", "GXL4"), "ascii")
    path.chmod(0o640)
    link.symlink_to(path)
    drycut("check", link, "--fix")
    assert link.is_symlink()
    assert path.read_text() == SOUND
    assert stat.S_IMODE(path.stat().st_mode) == 0o640
    assert sorted(file.name for file in tmp_path.iterdir()) == ["link.3b", "part.3b"]


def test_an_end_code_goes_before_the_nuls_that_fill_the_last_sector(tmp_path: Path) -> None:
    assert fixed(tmp_path / "part.3b", b"B1B0B1GXL1\r\nB1B0B1GXL3\r\n\x1a\0\0")[0].endswith(b"GXL3\r\nDD\r\n\x1a\0\0")
