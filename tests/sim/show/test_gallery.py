"""A picture that is in the gallery is named wherever pictures are named: texts, help, documents."""

import re

import pytest
from places import ROOT

from parser.findings.catalogue import LANGUAGES
from sim.show.pictures.fit import FIT
from sim.show.pictures.gallery import PICTURES
from sim.show.pictures.plan import PLAN
from sim.show.texts.texts import Words, texts

COUNTS = ["no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "eleven", "twelve"]


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_has_a_name_for_those_who_cannot_see_it(name: str) -> None:
    key = f"picture_{name}"
    assert key in texts("common"), f"sim/show/texts/common.toml has no {key}: what the picture is, in both languages"
    assert all(texts("common")[key])


def test_no_name_is_left_of_a_picture_that_there_is_not() -> None:
    named = {key.removeprefix("picture_") for key in texts("common") if key.startswith("picture_")}
    assert named - {*PICTURES, PLAN, FIT} == set(), "sim/show/texts/common.toml names pictures that nothing draws"


def test_the_help_of_draw_names_every_picture_and_says_what_it_shows() -> None:
    for language in LANGUAGES:
        say = Words(language)
        listed = re.findall(r"[a-z]{3,}", re.split("[;；]", say("options.draw-picture"))[0])
        assert listed == [*PICTURES], "the help of --picture in options.toml names others than PICTURES"
        told = re.findall(r"\b([a-z]+)(?=[,:、：])", say("commands.draw-more"))
        missing = [name for name in PICTURES if name not in told]
        assert missing == [], "the help of draw in commands.toml does not say what these show"


def test_the_manual_has_a_row_for_every_picture() -> None:
    table = (ROOT / "docs" / "pictures.md").read_text("utf-8").split("| picture | shows |")[1].split("\n\n")[0]
    rows = re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE)
    assert rows == [*PICTURES], "the table of docs/pictures.md has other pictures than PICTURES"


def test_the_tour_counts_the_pictures() -> None:
    told = f"`drycut draw` draws {COUNTS[len(PICTURES)]} pictures"
    assert told in (ROOT / "docs" / "start.md").read_text("utf-8"), f"docs/start.md does not say: {told}"


@pytest.mark.parametrize("name", PICTURES)
def test_a_picture_has_a_golden_one(name: str) -> None:
    assert (ROOT / "tests" / "golden" / f"{name}.png").exists(), f"no test holds {name} against a golden picture"
