"""Writes scripts of pages from plain Python: `make pages`.

Lessons read, step and mark 3B by `sim/teach/plain`; the panel of a control under sparks goes by `sim/process/ticks`.

It knows the part of Python that those files are written in, and refuses all else: functions of positional parameters,
named tuples, lists, arrays, numbers, texts, `math`. Numbers are doubles; what is divided with a rest is never negative.
That a function is a compiled loop is no matter of a script.
"""

import ast
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parents[2]


class Package(NamedTuple):
    """A package of plain modules, and the page whose script they become."""

    name: str
    modules: tuple[str, ...]
    page: str

    @property
    def folder(self) -> Path:
        return ROOT.joinpath(*self.name.split("."))

    @property
    def assets(self) -> Path:
        return ROOT / "sim" / "show" / self.page / "assets"


PACKAGES = (
    Package(
        "sim.teach.plain",
        ("blocks", "curves", "stepping", "tasks", "marks", "program", "answers", "rules"),
        "lesson_page",
    ),
    Package(
        "sim.process.ticks",
        ("state", "chance", "gap", "servo", "log", "events", "watch", "tick", "hands", "walls"),
        "panel_page",
    ),
)
LOOPS = {"compiled", "loop_part"}
TYPES = {"int": "number", "float": "number", "str": "string", "bool": "boolean", "Floats": "Float64Array"}
OPERATORS: dict[type, str] = {
    **{ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Mod: "%"},
    **{ast.Eq: "===", ast.NotEq: "!==", ast.Lt: "<", ast.LtE: "<=", ast.Gt: ">", ast.GtE: ">="},
    **{ast.And: "&&", ast.Or: "||", ast.USub: "-", ast.Not: "!"},
}
MATHS = {"math.inf": "Infinity", "math.pi": "Math.PI"}
CALLS = {"abs": "Math.abs", "min": "Math.min", "max": "Math.max", "chr": "String.fromCodePoint"}
METHODS = {"append": "push", "replace": "replaceAll", "find": "indexOf", "split": "split"}


def scripts() -> Iterator[tuple[Path, str]]:
    """Each file of the scripts, and what it is to hold."""
    for package in PACKAGES:
        yield from _scripts_of(package)


def _scripts_of(package: Package) -> Iterator[tuple[Path, str]]:
    trees = {name: ast.parse((package.folder / f"{name}.py").read_text("utf-8")) for name in package.modules}
    fields = {
        node.name: [item.target.id for item in node.body if isinstance(item, ast.AnnAssign)]  # type: ignore[union-attr]
        for tree in trees.values()
        for node in tree.body
        if isinstance(node, ast.ClassDef)
    }
    for name, tree in trees.items():
        yield package.assets / f"plain_{name}.js", _Module(tree, fields, package.name).text(name)


class _Module:
    """A file of Python as one of script."""

    def __init__(self, tree: ast.Module, fields: dict[str, list[str]], package: str) -> None:
        self._tree, self._fields, self._package = tree, fields, package

    def text(self, name: str) -> str:
        body, types, values = [], [], []
        for node in self._tree.body:
            if isinstance(node, ast.ImportFrom) and (node.module or "").startswith(f"{self._package}."):
                file = f'"./plain_{(node.module or "").removeprefix(f"{self._package}.")}.js"'
                names = [alias.name for alias in node.names]
                if used := [each for each in names if self._is_value(each)]:
                    values.append(f"import {{ {', '.join(used)} }} from {file};")
                if used := [each for each in names if not self._is_value(each)]:
                    types.append(f"/** @import {{ {', '.join(used)} }} from {file} */")
            elif isinstance(node, ast.Assign):
                body.append(self._constant(node))
            elif isinstance(node, ast.ClassDef):
                body.append(self._tuple(node))
            elif isinstance(node, ast.FunctionDef):
                body.append(self._function(node))
        head = f"// Written by `make pages` from {self._package.replace('.', '/')}/{name}.py."
        return "\n".join([head, *values, *types]) + "\n\n" + "\n\n".join(body) + "\n"

    def _is_value(self, name: str) -> bool:
        """Whether an imported name is used as a value: named tuples may be types alone."""
        calls = (node.func for node in ast.walk(self._tree) if isinstance(node, ast.Call))
        called = {func.id for func in calls if isinstance(func, ast.Name)}
        return name not in self._fields or name in called

    def _constant(self, node: ast.Assign) -> str:
        name = self._value(node.targets[0])
        return f"{'' if name.startswith('_') else 'export '}const {name} = {self._value(node.value)};"

    def _tuple(self, node: ast.ClassDef) -> str:
        items = [item for item in node.body if isinstance(item, ast.AnnAssign)]
        typed = [(self._value(item.target), self._type(item.annotation)) for item in items]
        names = ", ".join(name for name, _ in typed)
        properties = [f" * @property {{{type_}}} {name}" for name, type_ in typed]
        params = [f" * @param {{{type_}}} {name}" for name, type_ in typed]
        what = (ast.get_docstring(node) or "").split("\n")[0]
        give = "" if node.name.startswith("_") else "export "
        return "\n".join([
            *("/**", f" * {what}", f" * @typedef {{object}} {node.name}", *properties, " */", ""),
            *("/**", *params, f" * @returns {{{node.name}}}", " */"),
            f"{give}function {node.name}({names}) {{\n  return {{ {names} }};\n}}",
        ])  # fmt: skip

    def _function(self, node: ast.FunctionDef) -> str:
        args = [(arg.arg, self._type(arg.annotation)) for arg in node.args.args]
        loops = [
            each.func.id
            for each in node.decorator_list
            if isinstance(each, ast.Call) and isinstance(each.func, ast.Name)
        ]
        if node.args.kwonlyargs or node.args.defaults or node.args.vararg or len(loops) < len(node.decorator_list):
            raise SyntaxError(f"{node.name}: positional parameters alone")
        if set(loops) - LOOPS:
            raise SyntaxError(f"{node.name}: positional parameters alone")
        what = (ast.get_docstring(node) or "").split("\n")[0]
        docs = [f" * {what}"] if what else []
        docs += [f" * @param {{{type_}}} {name}" for name, type_ in args]
        docs.append(f" * @returns {{{self._type(node.returns)}}}")
        lines = _Body(self, [name for name, _ in args]).lines(node)
        give = "" if node.name.startswith("_") else "export "
        head = f"{give}function {node.name}({', '.join(name for name, _ in args)}) {{"
        return "\n".join(["/**", *docs, " */", head, *lines, "}"])

    def _type(self, node: ast.expr | None) -> str:
        if isinstance(node, ast.Subscript) and isinstance(node.value, ast.Name):
            if node.value.id == "list":
                return f"{self._type(node.slice)}[]"
            assert isinstance(node.slice, ast.Tuple)
            return f"[{', '.join(map(self._type, node.slice.elts))}]"
        if isinstance(node, ast.Constant) and node.value is None:
            return "void"
        assert isinstance(node, ast.Name), ast.dump(node) if node else "no type"
        return TYPES.get(node.id, node.id)

    def _value(self, node: ast.expr) -> str:  # noqa: C901, PLR0911, PLR0912 - a case for each form
        """An expression; what binds less tightly than what it stands in is in brackets."""
        match node:
            case ast.Constant(value=bool() as truth):
                return "true" if truth else "false"
            case ast.Constant(value=str() as text):
                return _quoted(text)
            case ast.Constant(value=int() | float() as number):
                return repr(number)
            case ast.Name(id=name):
                return name
            case ast.Attribute():
                return MATHS.get(ast.unparse(node), f"{self._value(node.value)}.{node.attr}")
            case ast.List(elts=items) | ast.Tuple(elts=items) | ast.Set(elts=items):
                return f"[{', '.join(map(self._value, items))}]"
            case ast.Subscript(value=of, slice=ast.Slice(lower=low, upper=high)):
                ends = [self._value(low) if low else "0", *([self._value(high)] if high else [])]
                return f"{self._value(of)}.slice({', '.join(ends)})"
            case ast.Subscript(value=of, slice=at):
                return f"{self._value(of)}[{self._value(at)}]"
            case ast.BinOp(left=left, op=ast.FloorDiv(), right=right):
                return f"Math.floor({self._within(left)} / {self._within(right)})"
            case ast.BinOp(left=left, op=operator, right=right):
                return f"{self._within(left)} {OPERATORS[type(operator)]} {self._within(right)}"
            case ast.UnaryOp(op=operator, operand=operand):
                return f"{OPERATORS[type(operator)]}{self._within(operand)}"
            case ast.BoolOp(op=operator, values=values):
                return f" {OPERATORS[type(operator)]} ".join(map(self._within, values))
            case ast.IfExp(test=test, body=body, orelse=orelse):
                return f"{self._within(test)} ? {self._within(body)} : {self._within(orelse)}"
            case ast.Compare():
                return self._compared(node)
            case ast.ListComp(elt=item, generators=[ast.comprehension(target=ast.Name(id=name), iter=over, ifs=[])]):
                return f"{self._items(over)}.map(({name}) => {self._within(item)})"
            case ast.JoinedStr(values=parts):
                return f"`{''.join(map(self._formatted, parts))}`"
            case ast.Call(func=ast.Name(id="any"), args=[ast.GeneratorExp(elt=item, generators=[every])]):
                return f"{self._items(every.iter)}.some(({self._value(every.target)}) => {self._value(item)})"
            case ast.Call():
                return self._called(node)
        raise SyntaxError(ast.unparse(node))

    def _formatted(self, part: ast.expr) -> str:
        """A part of a formatted text, of letters that mean nothing to a script."""
        if isinstance(part, ast.FormattedValue):
            return f"${{{self._value(part.value)}}}"
        return str(ast.literal_eval(part))

    def _within(self, node: ast.expr) -> str:
        is_compound = isinstance(node, ast.BinOp | ast.BoolOp | ast.IfExp | ast.Compare | ast.UnaryOp)
        return f"({self._value(node)})" if is_compound else self._value(node)

    def _compared(self, node: ast.Compare) -> str:
        parts, left = [], node.left
        for operator, right in zip(node.ops, node.comparators, strict=True):
            if isinstance(operator, ast.In | ast.NotIn):
                sign = "" if isinstance(operator, ast.In) else "!"
                parts.append(f"{sign}{self._within(right)}.includes({self._value(left)})")
            else:
                parts.append(f"{self._within(left)} {OPERATORS[type(operator)]} {self._within(right)}")
            left = right
        return " && ".join(parts)

    def _items(self, over: ast.expr) -> str:
        if isinstance(over, ast.Call) and ast.unparse(over.func) == "range" and len(over.args) == 1:
            return f"Array.from({{ length: {self._value(over.args[0])} }}, (_, at) => at)"
        return self._value(over)

    def _called(self, node: ast.Call) -> str:
        name, args = ast.unparse(node.func), list(map(self._value, node.args))
        if name in self._fields and node.keywords:
            named = {keyword.arg: self._value(keyword.value) for keyword in node.keywords}
            args += [named[field] for field in self._fields[name][len(args) :]]
        elif node.keywords:
            raise SyntaxError(ast.unparse(node))
        if isinstance(node.func, ast.Attribute) and not name.startswith("math."):
            return self._method(node.func, args)
        if name in {"len", "ord", "int", "float", "bool"}:
            of = self._within(node.args[0])
            return {
                "len": f"{of}.length",
                "bool": f"Boolean({args[0]})",
                "ord": f"(/** @type {{number}} */ ({of}.codePointAt(0)))",
            }.get(name, f"Number({args[0]})" if name == "float" else f"Math.trunc(Number({args[0]}))")
        return f"{CALLS.get(name, name.replace('math.', 'Math.'))}({', '.join(args)})"

    def _method(self, func: ast.Attribute, args: list[str]) -> str:
        if func.attr == "join":
            return f"{args[0]}.join({self._value(func.value)})"
        return f"{self._value(func.value)}.{METHODS[func.attr]}({', '.join(args)})"


class _Body:
    """The statements of a function. A name is declared where it is first set, or before the statement around that."""

    def __init__(self, module: _Module, names: list[str]) -> None:
        self._module, self._names = module, set(names)

    def lines(self, node: ast.FunctionDef) -> list[str]:
        self._often = _set_again(node)
        statements = node.body[1:] if ast.get_docstring(node) is not None else node.body
        return [line for statement in statements for line in self._statement(statement, 1)]

    def _statement(self, node: ast.stmt, depth: int) -> list[str]:  # noqa: C901, PLR0911 - as above
        pad, value = "  " * depth, self._module._value
        match node:
            case ast.Return(value=None):
                return [f"{pad}return;"]
            case ast.Break():
                return [f"{pad}break;"]
            case ast.Return(value=ast.expr() as returned):
                return [f"{pad}return {value(returned)};"]
            case ast.Expr(value=called):
                return [f"{pad}{value(called)};"]
            case ast.AugAssign(target=target, op=operator, value=by):
                return [f"{pad}{value(target)} {OPERATORS[type(operator)]}= {value(by)};"]
            case ast.AnnAssign(target=ast.Name(id=name), annotation=annotation, value=ast.expr() as set_to):
                self._names.add(name)
                type_ = f"/** @type {{{self._module._type(annotation)}}} */"
                return [f"{pad}{type_}", f"{pad}{self._word(name)} {name} = {value(set_to)};"]
            case ast.Assign(targets=[ast.Tuple(elts=targets)], value=ast.Tuple(elts=values)):
                return self._pairs(targets, values, depth)
            case ast.Assign(targets=[target], value=set_to):
                return self._assigned(target, value(set_to), pad)
            case ast.If():
                return self._branches(node, depth)
            case ast.While(test=test, body=body, orelse=[]):
                return [f"{pad}while ({value(test)}) {{", *self._block(body, depth + 1), f"{pad}}}"]
            case ast.For(target=ast.Name(id=name), iter=over, body=body, orelse=[]):
                return [f"{pad}{self._loop(name, over)} {{", *self._block(body, depth + 1), f"{pad}}}"]
        raise SyntaxError(ast.unparse(node))

    def _word(self, name: str) -> str:
        return "let" if name in self._often else "const"

    def _assigned(self, target: ast.expr, text: str, pad: str) -> list[str]:
        """Set a name, several of a list, or an entry of an array."""
        names = _own_names(target)
        written = self._module._value(target)
        if not names or any(name in self._names for name in names):
            return [f"{pad}{written} = {text};"]
        self._names.update(names)
        word = "let" if any(self._word(name) == "let" for name in names) else "const"
        return [f"{pad}{word} {written} = {text};"]

    def _pairs(self, targets: list[ast.expr], values: list[ast.expr], depth: int) -> list[str]:
        """Set several names at once; none of them stands in the values, which are worked out before."""
        pad, value = "  " * depth, self._module._value
        names = {node.id for target in targets for node in ast.walk(target) if isinstance(node, ast.Name)}
        used = {node.id for item in values for node in ast.walk(item) if isinstance(node, ast.Name)}
        if not names & used:
            pairs = zip(targets, values, strict=True)
            return [line for target, item in pairs for line in self._assigned(target, value(item), pad)]
        lefts, rights = ", ".join(map(value, targets)), ", ".join(map(value, values))
        return [f"{pad}[{lefts}] = [{rights}];"]

    def _branches(self, node: ast.If, depth: int) -> list[str]:
        pad, value = "  " * depth, self._module._value
        before = self._hoisted(node, pad)
        lines = [f"{pad}if ({value(node.test)}) {{", *self._block(node.body, depth + 1)]
        rest = node.orelse
        while len(rest) == 1 and isinstance(rest[0], ast.If):
            lines += [f"{pad}}} else if ({value(rest[0].test)}) {{", *self._block(rest[0].body, depth + 1)]
            rest = rest[0].orelse
        if rest:
            lines += [f"{pad}}} else {{", *self._block(rest, depth + 1)]
        return [*before, *lines, f"{pad}}}"]

    def _hoisted(self, node: ast.If, pad: str) -> list[str]:
        """Names that both branches set, declared before them."""
        own = [_names_set(branch) for branch in (node.body, node.orelse)]
        new = sorted((own[0] & own[1]) - self._names)
        self._names.update(new)
        return [f"{pad}let {name};" for name in new]

    def _block(self, body: list[ast.stmt], depth: int) -> list[str]:
        """Statements of a block, whose names end with it."""
        names = set(self._names)
        lines = [line for statement in body for line in self._statement(statement, depth)]
        self._names = names
        return lines

    def _loop(self, name: str, over: ast.expr) -> str:
        value = self._module._value
        if isinstance(over, ast.Call) and ast.unparse(over.func) == "range":
            low, high = ("0", *map(value, over.args))[-2:]
            return f"for (let {name} = {low}; {name} < {high}; {name} += 1)"
        return f"for (const {name} of {value(over)})"


def _names_set(body: list[ast.stmt]) -> set[str]:
    """Names that statements set, those within others too."""
    nodes = (node for statement in body for node in ast.walk(statement) if isinstance(node, ast.Assign))
    return {name for node in nodes for target in node.targets for name in _own_names(target)}


def _own_names(target: ast.expr) -> list[str]:
    """Names that are set: what stands in the brackets of an entry, and the array itself, are not."""
    if isinstance(target, ast.Tuple):
        return [name for each in target.elts for name in _own_names(each)]
    return [target.id] if isinstance(target, ast.Name) else []


def _set_again(node: ast.FunctionDef) -> set[str]:
    """Names that a function sets more than once, or in a loop that they were declared before."""
    counts: dict[str, int] = {}
    for inner in ast.walk(node):
        targets = inner.targets if isinstance(inner, ast.Assign) else []
        if isinstance(inner, ast.AugAssign | ast.AnnAssign):
            targets = [inner.target]
        for target in targets:
            for name in _own_names(target):
                counts[name] = counts.get(name, 0) + 1
    return {name for name, count in counts.items() if count > 1}


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return '"' + escaped.replace("\n", "\\n").replace("\r", "\\r").replace("\t", "\\t") + '"'


if __name__ == "__main__":
    for path, text in scripts():
        path.write_text(text, "utf-8")
