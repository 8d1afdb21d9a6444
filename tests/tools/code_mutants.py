"""Small changes of our own code, such as slip into it: a border, a number, a sign, a condition, a step left out.

Changes that no test could see are not made: of annotations, docstrings, unions of types, imports, asserts, `strict=`.
"""

import ast
import re
from collections.abc import Callable, Iterator
from itertools import islice
from types import UnionType
from typing import NamedTuple

_Values = Iterator[tuple[str, object]]
"""Fields of a node, each with another value."""

_COMPARED: dict[type[ast.cmpop], list[type[ast.cmpop]]] = {
    ast.Lt: [ast.LtE, ast.GtE],
    ast.LtE: [ast.Lt, ast.Gt],
    ast.Gt: [ast.GtE, ast.LtE],
    ast.GtE: [ast.Gt, ast.Lt],
    ast.Eq: [ast.NotEq],
    ast.NotEq: [ast.Eq],
    ast.In: [ast.NotIn],
    ast.NotIn: [ast.In],
    ast.Is: [ast.IsNot],
    ast.IsNot: [ast.Is],
}
_COMPUTED: dict[type[ast.operator], type[ast.operator]] = {
    ast.Add: ast.Sub,
    ast.Sub: ast.Add,
    ast.Mult: ast.Div,
    ast.Div: ast.Mult,
    ast.FloorDiv: ast.Mult,
    ast.Mod: ast.FloorDiv,
    ast.Pow: ast.Mult,
    ast.BitAnd: ast.BitOr,
    ast.BitOr: ast.BitAnd,
    ast.LShift: ast.RShift,
    ast.RShift: ast.LShift,
}
_PAIRS = [
    ("min", "max"),
    ("minimum", "maximum"),
    ("any", "all"),
    ("floor", "ceil"),
    ("argmin", "argmax"),
    ("logical_and", "logical_or"),
    ("left", "right"),  # sides of searchsorted and bisect
    ("bisect_left", "bisect_right"),
    ("sin", "cos"),
]
_OTHER = dict([*_PAIRS, *((other, one) for one, other in _PAIRS)])
_UNION = re.compile(r"[A-Z][a-z]\w*( \| [A-Z][a-z]\w*)+")  # of types, by their names
_ROUNDING = 1e-3
"""Numbers below allow for rounding: half or twice as much is as good, nothing or a thousand times as much is not."""


class _Change(NamedTuple):
    """A field of a node is given another value; `line` is where that is seen, `gone` the statement that is left out."""

    node: ast.AST
    field: str
    value: object
    line: int
    gone: ast.stmt | None = None


class Mutant(NamedTuple):
    """A module with one change: its tree with lines as they were, and the source of what was changed."""

    tree: ast.Module
    before: str
    after: str


def changed_lines(source: str) -> list[int]:
    """Lines of all small changes of the source of a module; the place of each in the list is its number."""
    return [change.line for change in _changes(ast.parse(source))]


def mutant(source: str, number: int) -> Mutant:
    """The module with the change of a number."""
    tree = ast.parse(source)
    change = next(islice(_changes(tree), number, None))
    before = _shown(change.gone or change.node)
    setattr(change.node, change.field, change.value)
    return Mutant(ast.fix_missing_locations(tree), before, "pass" if change.gone else _shown(change.node))


def _shown(node: ast.AST) -> str:
    return " ".join(ast.unparse(node).split())[:120]


def _changes(tree: ast.Module) -> Iterator[_Change]:
    line = 1
    for node in _code(tree):
        line = getattr(node, "lineno", line)  # a comprehension has none of its own
        for kind, changes in _BY_NODE.items():
            if isinstance(node, kind):
                for field, value in changes(node):
                    yield _Change(node, field, value, line)
        yield from _left_out_steps(node)


def _code(node: ast.AST) -> Iterator[ast.AST]:
    """The nodes of what runs, in the order of the source."""
    yield node
    for name, value in ast.iter_fields(node):
        if name in ("annotation", "returns", "decorator_list"):
            continue
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST) and not _is_left_out(child):
                yield from _code(child)


def _is_left_out(node: ast.AST) -> bool:
    is_text = isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
    is_strict = isinstance(node, ast.keyword) and node.arg == "strict"
    is_typing = isinstance(node, ast.If) and isinstance(node.test, ast.Name) and node.test.id == "TYPE_CHECKING"
    return is_text or is_strict or is_typing or isinstance(node, ast.Assert | ast.Import | ast.ImportFrom)


def _of_comparison(node: ast.Compare) -> _Values:
    for at, op in enumerate(node.ops):
        for other in _COMPARED[type(op)]:
            yield "ops", [*node.ops[:at], other(), *node.ops[at + 1 :]]


def _of_constant(node: ast.Constant) -> _Values:
    value = node.value
    if isinstance(value, bool):
        yield "value", not value
    elif isinstance(value, int):
        yield from (("value", value + by) for by in (1, -1))
    elif isinstance(value, float):
        low, high = (0.0, 1e3) if abs(value) < _ROUNDING else (0.5, 2.0)
        yield from (("value", value * by if value else by) for by in (low, high) if value or by)
    elif isinstance(value, str) and value in _OTHER:
        yield "value", _OTHER[value]


def _of_operation(node: ast.BinOp | ast.AugAssign) -> _Values:
    if type(node.op) in _COMPUTED and not _UNION.fullmatch(ast.unparse(node)):
        yield "op", _COMPUTED[type(node.op)]()


def _of_junction(node: ast.BoolOp) -> _Values:
    yield "op", ast.Or() if isinstance(node.op, ast.And) else ast.And()


def _of_sign(node: ast.UnaryOp) -> _Values:
    """`not x` becomes `not not x`, `-x` and `~x` become `+x`."""
    if isinstance(node.op, ast.Not):
        yield "operand", ast.UnaryOp(ast.Not(), node.operand)
    else:
        yield "op", ast.UAdd()


def _of_condition(node: ast.If | ast.IfExp | ast.While | ast.comprehension) -> _Values:
    if isinstance(node, ast.comprehension):
        yield from (("ifs", [*node.ifs[:at], *node.ifs[at + 1 :]]) for at in range(len(node.ifs)))
    elif not isinstance(node.test, ast.Compare | ast.UnaryOp):  # those have changes of their own
        yield "test", ast.UnaryOp(ast.Not(), node.test)


def _of_name(node: ast.Name | ast.Attribute) -> _Values:
    name = "id" if isinstance(node, ast.Name) else "attr"
    if isinstance(node.ctx, ast.Load) and getattr(node, name) in _OTHER:
        yield name, _OTHER[getattr(node, name)]


def _of_return(node: ast.Return) -> _Values:
    if node.value is not None and not (isinstance(node.value, ast.Constant) and node.value.value is None):
        yield "value", ast.Constant(None)


def _left_out_steps(node: ast.AST) -> Iterator[_Change]:
    """Statements left out whose names are not needed later on."""
    for field in ("body", "orelse"):
        body = getattr(node, field, [])
        for at, step in enumerate(body if isinstance(body, list) else []):
            into = step.targets if isinstance(step, ast.Assign) else []
            stored = bool(into) and not any(isinstance(part, ast.Name) for target in into for part in _parts(target))
            called = isinstance(step, ast.Expr) and not _is_left_out(step)
            if stored or called or isinstance(step, ast.AugAssign | ast.Continue | ast.Break | ast.Raise):
                rest = [*body[:at], ast.copy_location(ast.Pass(), step), *body[at + 1 :]]
                yield _Change(node, field, rest, step.lineno, step)


def _parts(target: ast.expr) -> list[ast.expr]:
    return list(target.elts) if isinstance(target, ast.Tuple) else [target]


_BY_NODE: dict[type[ast.AST] | UnionType, Callable[..., _Values]] = {
    ast.Compare: _of_comparison,
    ast.Constant: _of_constant,
    ast.BinOp | ast.AugAssign: _of_operation,
    ast.BoolOp: _of_junction,
    ast.UnaryOp: _of_sign,
    ast.If | ast.IfExp | ast.While | ast.comprehension: _of_condition,
    ast.Name | ast.Attribute: _of_name,
    ast.Return: _of_return,
}
