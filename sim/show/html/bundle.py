"""The script of a page: its modules, joined into one text, for a page opened from a file cannot load modules.

A module says what it needs and what it gives in statements that begin a line, and in these forms alone::

    import { countUpTo, clamp as bounded } from "./numbers.js";
    import * as words from "./words.js";
    export function newView() { … }          // or async function, class, const

In the joined text each module is a function that runs once, after those it imports, and returns what it exports. So
what a module does not export is its own, whatever the others call theirs. Doc comments, whose types are for tsc, are
left out where they have lines of their own.
"""

import functools
import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

_IMPORT = re.compile(r'^import (?:\{(?P<names>[^{}]*)\}|\* as (?P<all>\w+)) from "(?P<file>[^"\n]+)";$', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=(?:async function|function|class|const) (?P<name>\w+))", re.MULTILINE)
_OTHER = re.compile(r"^(?:import|export)\b.*", re.MULTILINE)
_DOC = re.compile(r"^ */\*\*(?:(?!\*/).)*\*/\n", re.MULTILINE | re.DOTALL)
_ENDS_SCRIPT = re.compile(r"</script|<!--", re.IGNORECASE)


class _Import(NamedTuple):
    """One import: of which file, and pairs of a name there and the name here; `all_as` where it is of everything."""

    path: Path
    names: tuple[tuple[str, str], ...]
    all_as: str | None


class _Module(NamedTuple):
    """A module as it is written, with what it imports, in order, and the names that it exports."""

    path: Path
    text: str
    imports: tuple[_Import, ...]
    exports: tuple[str, ...]


@functools.cache
def joined(entry: Path) -> str:
    """Expression of an entry module with all that it imports; its value is an object of what the entry exports.

    The same files give the same text. Raises ValueError on a module that is missing, modules that import each other in
    a circle, a name that is imported and not exported, another form of import or export, and what would end the
    element ``<script>``.
    """
    modules = _in_order(entry)
    values = {module.path: f"${module.path.stem}_{number}" for number, module in enumerate(modules, 1)}
    scopes = "\n".join(_scope(module, values) for module in modules)
    return f'(() => {{\n"use strict";\n\n{scopes}\nreturn {values[entry.resolve()]};\n}})()'


def _in_order(entry: Path) -> list[_Module]:
    """The modules that an entry needs, each after those it imports, itself last."""
    done: dict[Path, _Module] = {}

    def visit(path: Path, under: tuple[Path, ...]) -> _Module:
        if path in under:
            circle = " -> ".join(one.name for one in (*under[under.index(path) :], path))
            raise ValueError(f"modules import each other in a circle: {circle}")
        if path not in done:
            module = _read(path, under[-1].name if under else "the page")
            for one in module.imports:
                _check(path, one, visit(one.path, (*under, path)))
            done[path] = module
        return done[path]

    visit(entry.resolve(), ())
    return list(done.values())


def _read(path: Path, importer: str) -> _Module:
    if not path.is_file():
        raise ValueError(f"{importer} imports {path.name}, which is not there: {path}")
    text = path.read_text("utf-8")
    if found := _ENDS_SCRIPT.search(text):
        raise ValueError(f"{path.name}: {found[0]} would end the script of a page")
    if found := _OTHER.search(_EXPORT.sub("", _IMPORT.sub("", text))):
        raise ValueError(f"{path.name}: cannot be joined: {found[0]}")
    exports = tuple(found["name"] for found in _EXPORT.finditer(text))
    return _Module(path, text, tuple(_imports(path, text)), exports)


def _imports(path: Path, text: str) -> Iterator[_Import]:
    for found in _IMPORT.finditer(text):
        names = (name.split() for name in (found["names"] or "").split(",") if name.strip())
        pairs = tuple((name[0], name[-1]) for name in names)
        yield _Import((path.parent / found["file"]).resolve(), pairs, found["all"])


def _check(path: Path, one: _Import, module: _Module) -> None:
    """ValueError where a module does not export what another one imports from it."""
    for name, _ in one.names:
        if name not in module.exports:
            raise ValueError(f"{path.name} imports {name}, which {module.path.name} does not export")


def _scope(module: _Module, values: dict[Path, str]) -> str:
    """A module as a function of its own, called at once."""
    imports = iter(module.imports)

    def taken(_: re.Match[str]) -> str:
        one = next(imports)
        names = ", ".join(name if name == here else f"{name}: {here}" for name, here in one.names)
        return f"const {one.all_as or f'{{ {names} }}'} = {values[one.path]};"

    body = re.sub(r"\n{3,}", "\n\n", _DOC.sub("", _EXPORT.sub("", _IMPORT.sub(taken, module.text)))).strip("\n")
    return f"const {values[module.path]} = (() => {{\n{body}\nreturn {{ {', '.join(module.exports)} }};\n}})();\n"
