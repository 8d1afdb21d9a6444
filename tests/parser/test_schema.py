"""Schemas made of models: what mypy takes of a model they take, and nothing else; an independent validator says so."""

from typing import Annotated, Any, Literal, TypedDict

import pytest
from jsonschema import Draft202012Validator

from parser.documents import (
    BlockRange,
    Code,
    Count,
    Document,
    Law,
    Ordinal,
    Positive,
    Size,
    Text,
    between,
    document_schema,
    of_length,
    one_of,
)


class Hole(TypedDict):
    """A hole
    of the part.
    """

    kind: Literal["round", "slot"]
    radius_um: Positive | None


class Part(TypedDict):
    """All kinds of fields."""

    schema: Literal["drycut.part/2"]
    name: Text
    axis: Annotated[str, one_of("X", "Y")]
    number: Ordinal
    blocks: BlockRange
    area: Size
    turn_deg: Annotated[float, between(-180, 180)] | None
    holes: Annotated[list[Hole], of_length(1, 2)]
    spare: Hole | None
    codes: dict[Code, Count]
    where: list[float] | bool


DOCUMENT = Document(
    Part, "docs/part.md", (Law(Hole, "kind", Literal["round"], {"radius_um": Positive}, {"radius_um": None}),)
)
SCHEMA = document_schema(DOCUMENT)


def part(**changed: Any) -> dict[str, Any]:
    sound = {
        "schema": "drycut.part/2",
        "name": "die",
        "axis": "X",
        "number": 1,
        "blocks": [1, 2],
        "area": 0.0,
        "turn_deg": None,
        "holes": [{"kind": "slot", "radius_um": None}],
        "spare": None,
        "codes": {"3B101": 0},
        "where": [],
    }
    return sound | changed


def takes(value: object) -> bool:
    return bool(Draft202012Validator(SCHEMA).is_valid(value))


def test_the_schema_is_one_of_its_draft_and_takes_a_sound_document() -> None:
    Draft202012Validator.check_schema(SCHEMA)
    assert takes(part())


@pytest.mark.parametrize(
    "changed",
    [
        {"axis": "Y"},
        {"turn_deg": -180},
        {"holes": [{"kind": "round", "radius_um": 0.1}, {"kind": "slot", "radius_um": None}]},
        {"spare": {"kind": "round", "radius_um": 2.5}},
        {"codes": {}},
        {"where": True},
        {"where": [1.5, 2.5, 3.5]},
    ],
)
def test_what_a_model_allows_the_schema_takes(changed: dict[str, Any]) -> None:
    assert takes(part(**changed))


@pytest.mark.parametrize(
    "changed",
    [
        {"schema": "drycut.part/1"},
        {"name": ""},
        {"axis": "Z"},
        {"number": 0},
        {"number": 1.5},
        {"blocks": [1]},
        {"blocks": [0, 1]},
        {"area": -0.1},
        {"turn_deg": 180.1},
        {"turn_deg": "1"},
        {"holes": []},
        {"holes": [{"kind": "slot", "radius_um": None}] * 3},
        {"holes": [{"kind": "slot"}]},
        {"holes": [{"kind": "round", "radius_um": None}]},
        {"holes": [{"kind": "round", "radius_um": 0}]},
        {"spare": {"kind": "slot", "radius_um": 1.0}},
        {"codes": {"3B1": 1}},
        {"codes": {"3B101": -1}},
        {"where": None},
        {"more": 1},
    ],
)
def test_what_a_model_does_not_allow_the_schema_refuses(changed: dict[str, Any]) -> None:
    assert not takes(part(**changed))


@pytest.mark.parametrize("key", part())
def test_every_key_is_always_there(key: str) -> None:
    whole = part()
    del whole[key]
    assert not takes(whole)


def test_a_document_has_the_name_of_its_schema_and_its_parts_say_what_they_are() -> None:
    assert (SCHEMA["title"], SCHEMA["description"]) == (
        "drycut.part/2",
        "All kinds of fields. Key by key: docs/part.md.",
    )
    assert SCHEMA["$defs"]["Hole"]["description"] == "A hole of the part."


def test_two_models_of_one_name_are_refused() -> None:
    other = TypedDict("Hole", {"depth_um": float})  # type: ignore[misc]  # noqa: UP013
    both = TypedDict("both", {"schema": Literal["drycut.both/1"], "first": Hole, "second": other})  # noqa: UP013
    with pytest.raises(TypeError, match="Hole"):
        document_schema(Document(both, "docs/both.md"))


def test_a_type_that_no_document_has_is_refused() -> None:
    odd = TypedDict("odd", {"schema": Literal["drycut.odd/1"], "when": complex})  # noqa: UP013
    with pytest.raises(TypeError, match="complex"):
        document_schema(Document(odd, "docs/odd.md"))
