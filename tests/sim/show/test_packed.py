"""Columns that are handed over packed come back as they were, in a real browser."""

import json
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import pytest
from browser import Browsers, Pages
from depth import examples
from hypothesis import given, settings
from hypothesis import strategies as st
from places import ROOT

from sim.show.html import packed as packed_module
from sim.show.html.environment import joined
from sim.show.html.packed import LONG, packed

if TYPE_CHECKING:
    from playwright.sync_api import Page

SCRIPT = joined(ROOT / "sim" / "show" / "html" / "assets" / "packed.js")

DECIMALS = st.builds(lambda whole, digits: whole / 10**digits, st.integers(-(10**12), 10**12), st.integers(0, 12))
NUMBERS = st.integers(-(2**53), 2**53) | DECIMALS | st.floats(allow_nan=False, allow_infinity=False)
VALUES = st.one_of(
    st.lists(NUMBERS, min_size=1),
    st.lists(st.none() | DECIMALS, min_size=1),
    st.lists(st.none() | st.text(), min_size=1),
    st.lists(st.lists(st.text()), min_size=1),
)


@pytest.fixture(scope="module")
def page(browsers: Browsers, tmp_path_factory: pytest.TempPathFactory) -> Iterator["Page"]:
    pages = Pages(browsers.of, tmp_path_factory.mktemp("packed"))
    script = f"<script>const {{ unpacked }} = {SCRIPT};</script>"
    yield pages.open(f"<!doctype html><html lang=en><title>packed</title>{script}").page
    pages.close()


def back(page: "Page", values: list[Any]) -> tuple[Any, bool]:
    """Values as a page has them, and whether they were packed; its texts tell −0 and 0 apart no more than JSON does."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(packed_module, "LONG", 0)
        handed = json.loads(json.dumps(packed(values)))
    found = page.evaluate("async (column) => JSON.stringify(Array.from(await unpacked(column)))", handed)
    return json.loads(found, parse_int=float), isinstance(handed, dict)  # JavaScript writes 2.0**60 without a point


@settings(max_examples=examples(60))
@given(VALUES)
def test_every_value_comes_back(page: "Page", values: list[Any]) -> None:
    found, was_packed = back(page, values)
    assert found == values
    assert was_packed


def test_short_columns_stay_as_they_are() -> None:
    short = [1.5] * (LONG - 1)
    assert packed(short) is short


@pytest.mark.parametrize(
    "values", [[float(at % 7) for at in range(9000)], [round(0.1 * at, 6) for at in range(9000)], ["B5GXL1"] * 9000]
)
def test_long_columns_take_less_room(values: list[Any]) -> None:
    assert len(json.dumps(packed(values))) < 0.45 * len(json.dumps(values))
