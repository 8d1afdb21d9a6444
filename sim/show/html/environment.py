"""Templates of the pages: one self-contained file each, and whatever a program or a scenario says stands escaped.

The script of a page: its modules, joined into one text, for a page opened from a file cannot load modules.

A module says what it needs and what it gives in statements that begin a line, and in these forms alone::

    import { countUpTo, clamp as bounded } from "./numbers.js";
    import * as words from "./words.js";
    export function newView() { … }          // or async function, class, const

In the joined text each module is a function that runs once, after those it imports, and returns what it exports. So
what a module does not export is its own, whatever the others call theirs. Doc comments, whose types are for tsc, are
left out where they have lines of their own.
"""

import functools
import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from parser import __version__
from sim.show.draw.style import DARK, LIGHT, OF_LEANS, Theme
from sim.show.html.bytecode import Bytecode
from sim.show.texts import bilingual
from sim.show.texts.texts import texts

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
            circle = " -> ".join(each_path.name for each_path in (*under[under.index(path) :], path))
            raise ValueError(f"modules import each other in a circle: {circle}")
        if path not in done:
            module = _read(path, under[-1].name if under else "the page")
            for import_ in module.imports:
                _check(path, import_, visit(import_.path, (*under, path)))
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


def _check(path: Path, import_: _Import, module: _Module) -> None:
    """ValueError where a module does not export what another one imports from it."""
    for name, _ in import_.names:
        if name not in module.exports:
            raise ValueError(f"{path.name} imports {name}, which {module.path.name} does not export")


def _scope(module: _Module, values: dict[Path, str]) -> str:
    """A module as a function of its own, called at once."""
    imports = iter(module.imports)

    def as_constant(_: re.Match[str]) -> str:
        import_ = next(imports)
        names = ", ".join(name if name == here else f"{name}: {here}" for name, here in import_.names)
        return f"const {import_.all_as or f'{{ {names} }}'} = {values[import_.path]};"

    body = re.sub(r"\n{3,}", "\n\n", _DOC.sub("", _EXPORT.sub("", _IMPORT.sub(as_constant, module.text)))).strip("\n")
    return f"const {values[module.path]} = (() => {{\n{body}\nreturn {{ {', '.join(module.exports)} }};\n}})();\n"


_SHARED = Path(__file__).with_name("assets")
_ESCAPED = {character: f"\\u{ord(character):04x}" for character in "<>&\u2028\u2029"}


def rendered(assets: Path, template: str, **values: Any) -> str:
    """Page of a template in the folder `assets`, which may extend ``base.html.j2`` and import ``words.html.j2``.

    In a template ``{{ inlined("page.css") }}`` is a style sheet of the folder as it stands, ``{{ joined("main.js") }}``
    its module with all that this imports (see the head of this file), ``{{ value | script_json }}`` data for a script,
    ``{{ script_words("replay_scripts") | script_json }}`` a file of texts for scripts, which look for them in the
    element ``words``, and ``said("replay.quiz")`` a text in both languages; all else is escaped.
    """
    return _environment(assets).get_template(template).render(**values)


@cache
def _environment(assets: Path) -> Environment:
    """What templates of a folder are read by, each of them once in a process: a shop has thousands of pages."""
    environment = Environment(
        loader=FileSystemLoader([assets, _SHARED]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        bytecode_cache=Bytecode(),
    )
    environment.filters["script_json"] = script_json
    environment.globals |= {
        "drycut_version": __version__,
        "inlined": _Inlined(environment),
        "joined": lambda name: Markup(joined(assets / name)),  # noqa: S704 - as in _Inlined
        "said": bilingual,
        "script_words": _script_words,
        "theme_css": theme_css,
    }
    return environment


class _Inlined:
    """Text of an asset, as it stands."""

    def __init__(self, environment: Environment) -> None:
        self._environment = environment

    def __call__(self, name: str) -> Markup:
        loader = self._environment.loader
        assert loader is not None  # noqa: S101 - given in `rendered`
        text, *_ = loader.get_source(self._environment, name)
        return Markup(text)  # noqa: S704 - a file of this package, never of a user


def _script_words(file: str) -> dict[str, dict[str, str]]:
    """Templates of a file by their names, each in both languages."""
    return {name: text._asdict() for name, text in texts(file).items()}


def script_json(value: Any) -> Markup:
    """JSON of a value for ``<script type="application/json">``: nothing in it ends the element or opens a comment.

    ``<``, ``>``, ``&`` and the line ends U+2028 and U+2029 occur in strings alone, where JSON knows them by number too.
    Raises ValueError on NaN and infinities, which JSON has not.
    """
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    for character, escaped in _ESCAPED.items():  # ten times as fast as `str.translate`, over megabytes
        text = text.replace(character, escaped)
    return Markup(text)  # noqa: S704 - escaped just above


def theme_css(*, leans: bool = False) -> Markup:
    """Every paint as ``--name``: light, and dark on a screen that is set so; with `leans` those of a leaning wire."""
    light, dark = (_root({paint: of[paint] for paint in of if leans or paint not in OF_LEANS}) for of in (LIGHT, DARK))
    css = f"{light}\n@media screen and (prefers-color-scheme: dark) {{ {dark} }}"
    return Markup(css)  # noqa: S704 - names and numbers of this package


def _root(theme: Theme) -> str:
    paints = " ".join("--{}: #{:02x}{:02x}{:02x};".format(paint.value, *colour) for paint, colour in theme.items())
    return f":root {{ {paints} }}"
