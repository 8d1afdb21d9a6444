"""Programs of ISO in which nothing moves: each command says so, and none fails."""

from pathlib import Path

import pytest
from checking import drycut
from places import SCENARIOS

TEXT = "G92 X0 Y0\nG90\nM02\n"
DRAWING = str(SCENARIOS / "round-hole" / "drawing.dxf")


@pytest.mark.parametrize(
    ("command", "code"),
    [
        (("check", "still.iso"), 1),
        (("run", "still.iso"), 2),
        (("draw", "still.iso", "-o", "still.png"), 2),
        (("replay", "still.iso", "-o", "still.gif"), 2),
        (("compare", "still.iso", DRAWING), 2),
        (("convert", "still.iso", "-o", "still.3b"), 1),
    ],
    ids=lambda given: given[0] if isinstance(given, tuple) else "",
)
def test_a_program_without_motion_is_refused(tmp_path: Path, command: tuple[str, ...], code: int) -> None:
    (tmp_path / "still.iso").write_text(TEXT, "ascii")
    ended, out, err = drycut(*command, cwd=tmp_path)
    assert ended == code
    assert "ISO100" in out + err
    assert "no block in the file moves the wire" in out + err
    assert [file.name for file in tmp_path.iterdir()] == ["still.iso"]
