"""docs/iso.md, section 8, against what decoding really gives."""

import re

import pytest
from places import ROOT

from controller.decode.blocks import decoded
from controller.decode.document import block_entry
from controller.offset.joints import JointKind
from parser.dialect.reader import Choices
from parser.program import parse_program

SECTION = re.split(r"^## ", (ROOT / "docs" / "iso.md").read_text(encoding="utf-8"), flags=re.MULTILINE)[8]
EXAMPLES = re.findall(
    r"^\| `([^`]+)`[^|]* \| (\S+) \| (\S+), (\S+) \| (\S+) \| (0x\w+) \| (\S+) \|$", SECTION, re.MULTILINE
)


def test_every_joint_is_told() -> None:
    rows = re.findall(r"^\| (`[-a-z`, ]+) \| [a-z]", SECTION, re.MULTILINE)
    told = {name for row in rows for name in re.findall(r"`([-a-z]+)`", row)}

    assert {kind.value for kind in JointKind} - {"none"} <= told


def test_there_are_three_examples() -> None:
    assert len(EXAMPLES) == 3


@pytest.mark.parametrize("row", EXAMPLES, ids=[row[0] for row in EXAMPLES])
def test_examples_give_the_figures_of_the_table(row: tuple[str, ...]) -> None:
    text, number, x, y, feed, flags, register = row
    program = parse_program(text, "part.iso", choices=Choices(dialect="classroom"))
    entry = block_entry(decoded(program, program.toolpath)[0])

    assert [entry["coor_um"]["X"], entry["coor_um"]["Y"]] == [float(one.replace("−", "-")) for one in (x, y)]
    assert entry["g0"] == int(flags, 16)
    assert [entry[key] for key in ("number", "f", "d")] == [
        None if one == "–" else int(one) for one in (number, feed, register)
    ]
