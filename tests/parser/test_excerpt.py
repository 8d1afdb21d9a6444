"""A source line with carets, in cells of a terminal."""

import pytest

from parser.text.places import caret_lines, cells, place


def test_place_names_what_is_known() -> None:
    assert place("a.3b", 7, 12) == "a.3b:7:12"
    assert place("a.3b", 7, 0) == "a.3b:7"
    assert place("a.3b", None, None) == "a.3b"


def test_carets_stand_under_the_span() -> None:
    assert caret_lines("B1B2B3GXL1", 7, 2) == ("B1B2B3GXL1", "      ^^")


@pytest.mark.parametrize(
    ("excerpt", "column", "width", "carets"),
    [
        ("加工B1", 3, 1, "    ^"),
        ("B1加工", 3, 2, "  ^^^^"),
        ("e\u0301B1", 3, 1, " ^"),
        ("½×B1", 3, 1, "  ^"),
        ("ﾌﾞB1", 3, 1, "  ^"),
    ],
)
def test_wide_characters_take_two_cells(excerpt: str, column: int, width: int, carets: str) -> None:
    assert caret_lines(excerpt, column, width)[1] == carets


def test_there_is_always_a_caret() -> None:
    assert caret_lines("B1", 3, 0) == ("B1", "  ^")
    assert caret_lines("", 1, 1) == ("", "^")
    assert caret_lines("B1", 2, 99) == ("B1", " ^")


def test_long_lines_are_windowed() -> None:
    shown, carets = caret_lines("a" * 500 + "B" + "c" * 500, 501, 300)
    assert len(shown) == 100
    assert shown[carets.index("^")] == "B"
    assert len(carets) == 100


def test_controls_are_shown() -> None:
    assert caret_lines("\x1b\tB\r", 3) == ("\ufffd B\ufffd", "  ^")
    assert cells("加B") == 3
