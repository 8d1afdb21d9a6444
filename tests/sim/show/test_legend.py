"""Legends: entries in rows and in columns, none over another nor over the edge of the page."""

from itertools import pairwise

import pytest
from recorder import Recorder

from sim.show.draw import style
from sim.show.draw.layout import Box
from sim.show.draw.legend import Entry, Legend, LegendSizes, draw_at_foot, draw_legend, in_columns, in_rows, stroke
from sim.show.draw.letters import text_width
from sim.show.draw.style import Paint

WIDTH_PX, HEIGHT_PX = 1600, 900
LINE = stroke(Paint.INK, 2.0)


def entries(*texts: str, width: float = 1.0) -> list[Entry]:
    return [Entry(LINE, text, width) for text in texts]


def drawn(legend: Legend, left: float = 0.0, top: float = 0.0) -> list[tuple[Box, str]]:
    """Box from the sample to the end of the text, and the text, of each entry."""
    canvas = Recorder(WIDTH_PX, HEIGHT_PX)
    draw_legend(canvas, legend, left, top)
    boxes = []
    for sample, text in zip(canvas.of("polyline", Paint.INK), canvas.of("text", Paint.INK), strict=True):
        written, size = text.more[0], text.more[1]
        half = legend.sizes.row * legend.unit / 2.0
        right = text.at[0] + text_width(written, size)
        boxes.append((Box(sample.at[0, 0], text.at[1] - half, right, text.at[1] + half), written))
    return boxes


def test_a_row_is_as_full_as_the_page_is_wide() -> None:
    texts = [f"entry {number} of the legend" for number in range(9)]
    legend = in_rows(entries(*texts), WIDTH_PX, 1.0)
    boxes = drawn(legend)
    assert [text for _, text in boxes] == texts
    assert legend.rows == 3
    assert max(box.right for box, _ in boxes) <= WIDTH_PX - style.EDGE
    for (one, _), (other, _) in pairwise(boxes):
        if other.top == one.top:
            assert other.left == pytest.approx(one.right + legend.sizes.apart)
        else:
            assert one.right + legend.sizes.apart + (other.right - other.left) > WIDTH_PX - style.EDGE


def test_an_entry_that_is_wider_than_the_page_has_a_row_of_its_own_and_its_whole_text() -> None:
    legend = in_rows(entries("short", "long " * 60, "short"), WIDTH_PX, 1.0)
    assert [text for _, text in drawn(legend)] == ["short", "long " * 60, "short"]
    assert [row for _, row, _, _ in legend.placed] == [0, 1, 2]


def test_columns_fill_the_width_one_below_the_other() -> None:
    legend = in_columns(entries(*"abcdefg"), 3, 1000.0, 1.0)
    boxes = drawn(legend)
    assert legend.rows == 3
    assert [round(box.top / style.LEGEND_ROW) for box, _ in boxes] == [0, 1, 2, 0, 1, 2, 0]
    assert len({box.left for box, _ in boxes}) == 3


def test_texts_without_room_in_their_column_lose_their_middle() -> None:
    boxes = drawn(in_columns(entries(*["a text that is far too long " * 3] * 4), 2, 700.0, 1.0))
    assert all("…" in text for _, text in boxes)
    assert max(box.right for box, _ in boxes[:2]) <= min(box.left for box, _ in boxes[2:])
    assert max(box.right for box, _ in boxes) <= 700.0


@pytest.mark.parametrize("unit", [0.45, 2.0])
def test_all_sizes_follow_the_unit(unit: float) -> None:
    sizes = LegendSizes(row=40.0, sample=50.0, text=20.0, apart=30.0)
    small, large = (
        drawn(in_rows(entries("one", "two", width=1.5), 1600 * factor, factor, sizes)) for factor in (1.0, unit)
    )
    for (one, _), (other, _) in zip(small, large, strict=True):
        assert tuple(other) == pytest.approx(tuple(side * unit for side in one), abs=1.0)  # texts have whole pixels


def test_a_legend_at_the_foot_ends_above_the_edge_of_the_page() -> None:
    legend, canvas = in_rows(entries("one", "two"), WIDTH_PX, 1.0), Recorder(WIDTH_PX, HEIGHT_PX)
    draw_at_foot(canvas, legend)
    assert legend.height < legend.foot
    assert canvas.of("text", Paint.INK)[0].at[1] == pytest.approx(HEIGHT_PX - legend.foot + style.LEGEND_ROW / 2.0)


def test_columns_of_nothing_take_no_row() -> None:
    assert in_columns([], 3, 1000.0, 1.0).rows == 0
    assert drawn(in_columns([], 3, 1000.0, 1.0)) == []
