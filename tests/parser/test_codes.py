"""Codes stand in their table and where a finding is made; nothing is decided by one."""

import ast
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from places import ROOT
from trees import trees_of

from parser.findings.codes import CODES, CODES_OF_ISO

CODE = re.compile(r"(?:3B|GEC|ISO|PMC)\d{3}")
SPEAKS_OF_CODES = re.compile(r"3B\d|GEC\d|ISO\d|PMC\d|\.code\b|\.values\b")
MAKERS = {"Finding", "finding", "at_block", "at_word", "_at", "_at_first", "_of_span", "Bad"}
"""`Finding(code, …)`, `lines.finding(code, …)` and `at_block(toolpath, lines, code, …)` make one, and so do helpers of
modules; what cannot be read as a word goes by its code."""
TABLE = ROOT / "parser" / "findings" / "codes.py"
ALLOWED = ("CODES[", "settings.shows(", "job.settings.shows(")
DECIDERS = (ast.Compare, ast.Match, ast.If, ast.IfExp, ast.comprehension)


@cache
def modules() -> dict[Path, ast.Module]:
    """Modules of the packages that name a code, or ask a finding for its own."""
    found = ((ROOT / path, tree) for path, tree in trees_of("parser", "controller", "sim"))
    return {path: tree for path, tree in found if SPEAKS_OF_CODES.search(path.read_text(encoding="utf-8"))}


def is_code(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str) and bool(CODE.fullmatch(node.value))


def made(tree: ast.AST) -> Iterator[ast.Constant]:
    """Codes that are arguments, by place, of the calls that make findings."""
    for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call)):
        name = call.func.attr if isinstance(call.func, ast.Attribute) else getattr(call.func, "id", "")
        if name in MAKERS:
            yield from (one for argument in call.args for one in either(argument) if is_code(one))


def either(node: ast.expr) -> tuple[ast.expr, ...]:
    """What an argument may be: both ends of a choice, else itself."""
    return (node.body, node.orelse) if isinstance(node, ast.IfExp) else (node,)


def strays(tree: ast.AST) -> list[str]:
    """Codes of a module that make no finding."""
    making = set(map(id, made(tree)))
    return [f"line {node.lineno}: {node.value}" for node in ast.walk(tree) if is_code(node) and id(node) not in making]


def decisions(tree: ast.AST) -> list[str]:
    """Places of a module where the code or a value of a finding is compared, or decides a branch."""
    return [
        ast.unparse(inner)
        for node in ast.walk(tree)
        if isinstance(node, DECIDERS)
        for condition in conditions(node)
        for inner in looked_at(condition)
        if (isinstance(inner, ast.Attribute) and inner.attr == "code")
        or (
            isinstance(inner, ast.Subscript) and isinstance(inner.value, ast.Attribute) and inner.value.attr == "values"
        )
    ]


def looked_at(node: ast.AST) -> Iterator[ast.AST]:
    """A condition and its parts, but for what the table says of a code, and what a user selects by it."""
    if isinstance(node, ast.Subscript | ast.Call) and ast.unparse(node).startswith(ALLOWED):
        return
    yield node
    for child in ast.iter_child_nodes(node):
        yield from looked_at(child)


def conditions(node: ast.AST) -> list[ast.AST]:
    if isinstance(node, ast.Match):
        return [node.subject]
    if isinstance(node, ast.If | ast.IfExp):
        return [node.test]
    return list(node.ifs) if isinstance(node, ast.comprehension) else [node]


def test_codes_stand_in_the_table_and_where_findings_are_made() -> None:
    found = {str(path): strays(tree) for path, tree in modules().items() if path != TABLE}
    assert {path: codes for path, codes in found.items() if codes} == {}


def test_nothing_is_decided_by_a_code_or_a_value() -> None:
    of_the_card = ROOT / "controller"  # its codes are what the card's functions answer
    found = {str(path): decisions(tree) for path, tree in modules().items() if not path.is_relative_to(of_the_card)}
    assert {path: places for path, places in found.items() if places} == {}


def test_every_code_is_made_and_every_one_made_is_in_the_table() -> None:
    made_codes = {node.value for tree in modules().values() for node in made(tree)}
    assert made_codes | set(CODES_OF_ISO.values()) == set(CODES)
    assert set(CODES_OF_ISO) <= made_codes
    assert list(CODES) == sorted(CODES)


@pytest.mark.parametrize(
    "text",
    [
        "_EXPLAIN = ('3B204', '3B207')",
        "found = [f for f in findings if f.code == '3B301']",
        "makers = {'3B102': known.end_code}",
        "at('3B402', loss)",
        "Finding(CODE, {'3B402': 1})",
    ],
)
def test_a_code_that_makes_no_finding_is_a_stray(text: str) -> None:
    assert strays(ast.parse(text))


@pytest.mark.parametrize(
    "text",
    [
        "any(finding.code in _DOUBT for finding in findings)",
        "[f for f in findings if f.values['field'] == 'field-axis']",
        "match finding.code:\n    case _: pass",
        "if finding.code.startswith(LAYER): pass",
        "edits if finding.values['first'] else ()",
    ],
)
def test_a_branch_on_a_code_or_a_value_is_a_decision(text: str) -> None:
    assert decisions(ast.parse(text))
