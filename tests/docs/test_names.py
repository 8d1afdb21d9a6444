"""Names of the code: nouns of the field, none of the words that say nothing alone; `docs/words.toml` lists both."""

import ast
import re
import tomllib
from collections.abc import Iterator
from functools import cache

import pytest
from places import ROOT
from trees import trees

WORDS = tomllib.loads((ROOT / "docs" / "words.toml").read_text("utf-8"))
NO_NAMES = frozenset(WORDS["no-names"]["words"])
NO_VARIABLES = frozenset(WORDS["no-variables"]["words"])


@cache
def code() -> str:
    """All code without its layout, names in words."""
    return "\n".join(map(ast.unparse, trees().values())).replace("_", " ")


def is_model(node: ast.AST) -> bool:
    """Whether a class is the model of a document, whose fields are keys that users know."""
    return isinstance(node, ast.ClassDef) and [ast.unparse(base) for base in node.bases] == ["TypedDict"]


def fields_of(model: ast.AST) -> list[ast.AnnAssign]:
    return [field for field in ast.walk(model) if isinstance(field, ast.AnnAssign)]


def bare(tree: ast.AST) -> Iterator[str]:
    """Functions, methods, classes, parameters and variables that a word of the lists alone names."""
    keys = {id(field.target) for model in ast.walk(tree) if is_model(model) for field in fields_of(model)}
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and node.name.strip("_").lower() in NO_NAMES:
            yield f"{node.lineno}: {node.name}"
        elif isinstance(node, ast.arg) and node.arg in NO_VARIABLES:
            yield f"{node.lineno}: {node.arg}"
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store) and node.id in NO_VARIABLES:
            if id(node) in keys:
                continue
            yield f"{node.lineno}: {node.id}"


def test_no_function_class_or_variable_has_a_name_that_says_nothing() -> None:
    assert [f"{path}:{name}" for path, tree in trees().items() for name in bare(tree)] == []


@pytest.mark.parametrize(
    ("source", "found"),
    [
        ("def kept(): ...", ["1: kept"]),
        ("class _Asked: ...", ["1: _Asked"]),
        ("for one in passes: ...", ["1: one"]),
        ("[one for one in passes]", ["1: one"]),
        ("lambda one: one", ["1: one"]),
        ("told = words", ["1: told"]),
        ("lambda asked: 1", ["1: asked"]),
        ("left = box.left", []),
        ("class Host:\n    kept: int", ["2: kept"]),
        ("class CardEntry(TypedDict):\n    asked: int", []),
        ("def kept_rows(): ...", []),
        ("for block in blocks: ...", []),
    ],
)
def test_a_bare_name_is_found(source: str, found: list[str]) -> None:
    assert list(bare(ast.parse(source))) == found


@pytest.mark.parametrize("word", WORDS["words"])
def test_each_word_of_the_glossary_is_one_that_the_code_uses(word: str) -> None:
    assert re.search(rf"\b{re.escape(word)}(e?s)?\b", code(), re.IGNORECASE)


@pytest.mark.parametrize("word", WORDS["words"])
def test_each_word_is_explained_in_a_sentence(word: str) -> None:
    meaning = WORDS["words"][word]
    assert meaning[0].isupper()
    assert meaning.endswith(".")
    assert len(meaning) <= 160
