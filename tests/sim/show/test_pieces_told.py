"""What terminal and page tell of pieces: what is still cut of them, where they can be clamped, how far they shift."""

from runs import run_text

from sim.run.report import build_report
from sim.show.report_page.tables import piece_table
from sim.show.terminal.run import summary_rows

ROUND = "B0B3000B3000GYL2 B2000B0B2000GXL1 B0B4000B4000GYL2 B4000B0B4000GXL3 B0B4000B4000GYL4 "
CLOSE = "B2000B0B2000GXL1"
IN_AND_OUT = " B0B2000B2000GYL2 B0B5000B5000GYL4 DD"
BACK = " B0B3000B3000GYL4 DD"


def told(text: str) -> tuple[str, dict[str, object]]:
    """The terminal's line on the one piece of a program, and its row of the page's table, by English heads."""
    run = run_text(text, kerf=True)
    (line,) = (value for name, value in summary_rows(run) if name == "pieces")
    table = piece_table(build_report(run)["remains"]["pieces"], run.block_names)
    return line, {column.head.en: column.values[0] for column in table.columns}


def test_a_piece_that_is_still_cut_says_how_much() -> None:
    line, row = told(ROUND + CLOSE + IN_AND_OUT)
    assert line.endswith(" mm of it still to be cut")
    assert row["drops early"] == "yes"
    assert row["can be clamped at D behind block"] is None
    assert f"{row['cut on'] / 1000.0:,.3f} mm" in line


def test_a_piece_on_a_bridge_says_where_it_can_be_clamped() -> None:
    line, row = told(ROUND + "D " + CLOSE + IN_AND_OUT)
    assert line.endswith("can be clamped at the D behind block 5")
    assert (row["drops early"], row["can be clamped at D behind block"]) == ("no", 5)


def test_other_pieces_say_how_far_they_shift_and_nothing_of_pinching() -> None:
    line, row = told(ROUND + CLOSE + BACK)
    assert line.startswith("part of ")
    assert "still" not in line
    assert "clamped" not in line
    assert 200.0 <= row["shifts by up to"] <= 300.0  # a kerf along the sides, its diagonal into a corner
    assert not [head for head in row if "pinch" in head]
