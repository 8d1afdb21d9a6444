"""docs/iso.md against the profiles and marks that it tells of."""

import re

import pytest
from places import ROOT

from parser.findings.catalogue import page
from parser.findings.codes import CODES
from parser.iso.family import amount
from parser.iso.marks import MARKS
from parser.iso.profiles.profile import PROFILES, profile

DOC = (ROOT / "docs/iso.md").read_text(encoding="utf-8")
SECTION = dict(re.findall(r"^## (\d+)\. .*\n((?:(?!## ).*\n)*)", DOC, re.MULTILINE))


def rows(section: str, *, first: str) -> list[list[str]]:
    """Cells of the rows of the table whose head begins with a word."""
    table = re.search(rf"^\| {first} \|.*\n\|[-|]+\n((?:\|.*\n)+)", SECTION[section], re.MULTILINE)
    assert table, first
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in table[1].splitlines()]


def test_profiles_stand_in_the_table_as_they_are() -> None:
    starts = {"absolute": "G90", "incremental": "G91"}
    told = [
        [
            *(f"`{of.name}`", amount(of.integer_um), amount(of.point_um) + (", or inch" if of.may_be_inch else "")),
            *(starts[of.distance], of.centers, " ".join(of.offset_letters)),
        ]
        for of in map(profile, PROFILES)
    ]
    assert [row[:6] for row in rows("6", first="profile")] == told


def test_marks_stand_in_their_order_with_the_families_that_they_tell() -> None:
    told = [re.findall(r"`(.*?)`", row[1])[0] for row in rows("6", first="mark")]
    families = [mark.dialect for mark in MARKS]
    once = [one for one, before in zip(families, ["", *families], strict=False) if one != before]
    assert told == [*once, "common"]


@pytest.mark.parametrize(("group", "name"), [("motion", "motion"), ("distance", "distance"), ("taper", "taper")])
def test_words_of_groups_are_those_of_the_profiles(group: str, name: str) -> None:
    words = next(row[1] for row in rows("3", first="group") if row[0] == name)
    told = {f"{float(number):g}" for number in re.findall(r"G(\d+)", words)}
    assert told == {number for number, effect in profile("common").g.items() if effect == group}


def test_sections_are_numbered_as_they_are_cited() -> None:
    assert list(SECTION) == [str(number) for number in range(1, 12)]
    cited = {
        number
        for code in CODES
        for language in ("en", "zh")
        for number in re.findall(r"docs/iso\.md §(\d+)", page(code, language).why + page(code, language).mend)
    }
    assert cited <= set(SECTION)


def test_codes_that_are_told_of_are_codes() -> None:
    assert set(re.findall(r"ISO\d{3}", DOC)) <= set(CODES)
