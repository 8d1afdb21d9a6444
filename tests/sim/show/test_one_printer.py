"""Everything that a command prints passes one printer: no other module prints, by any way that Python has."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from places import ROOT

TERMINAL = ROOT / "sim" / "show" / "terminal"
# Who may: the printer and the streams themselves; the bar of progress, of our own words, draws over itself; the card's
# library says why a call fails in the process of somebody's program, which has no printer.
MAY = {TERMINAL / "printer.py", TERMINAL / "streams.py", TERMINAL / "layout.py", ROOT / "sim" / "cli" / "progress.py"}
MAY |= {ROOT / "controller" / "card" / "abi" / "library.py"}
FLUSHES = {ROOT / "sim" / "cli" / "__init__.py": {"sys.stdout", "sys.stderr"}}
WAYS = {"print", "breakpoint", "help", "pprint", "echo", "secho", "style", "pager", "echo_via_pager", "Console"}
STREAMS = {"sys.stdout", "sys.stderr", "sys.__stdout__", "sys.__stderr__", "sys.displayhook"}
MODULES = {"rich", "rich.console", "rich.live", "rich.progress", "pprint", "curses", "colorama"}

HINTS = re.compile(rf"\b({'|'.join(WAYS)})\(|\b(std(out|err)|write|clear|print_exc|displayhook|{'|'.join(MODULES)})\b")
"""What a module holds that has any of these: to read the others would take a second."""


def dotted(node: ast.expr) -> str:
    """``sys.stdout`` of an attribute of a name; else nothing."""
    return (
        f"{node.value.id}.{node.attr}" if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) else ""
    )


def ways_out(source: str) -> Iterator[str]:
    """Each place of a module where it could print."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name | ast.Attribute):
            name = node.func.id if isinstance(node.func, ast.Name) else node.func.attr
            if name in WAYS or dotted(node.func) in {"os.write", "click.clear", "traceback.print_exc"}:
                yield name
        elif isinstance(node, ast.Attribute) and dotted(node) in STREAMS:
            yield dotted(node)
        elif isinstance(node, ast.Import | ast.ImportFrom):
            names = [node.module or ""] if isinstance(node, ast.ImportFrom) else [name.name for name in node.names]
            yield from (name for name in names if name in MODULES)
            if names == ["sys"] and isinstance(node, ast.ImportFrom):
                yield from (f"sys.{name.name}" for name in node.names if f"sys.{name.name}" in STREAMS)


def others() -> Iterator[tuple[Path, str]]:
    for package in ("parser", "controller", "sim"):
        for path in sorted((ROOT / package).rglob("*.py")):
            if path not in MAY and HINTS.search(text := path.read_text("utf-8")):
                yield path, text


def test_no_other_module_prints() -> None:
    found = {
        path.relative_to(ROOT).as_posix(): sorted(set(ways_out(text)) - FLUSHES.get(path, set()))
        for path, text in others()
    }
    assert {name: ways for name, ways in found.items() if ways} == {}


def test_every_way_to_print_would_be_found() -> None:
    for source in (
        "print('a')",
        "import click\nclick.echo('a')",
        "from click import secho\nsecho('a')",
        "import sys\nsys.stdout.write('a')",
        "from sys import stderr",
        "from rich.console import Console",
        "from rich import print",
        "import os\nos.write(1, b'a')",
    ):
        assert list(ways_out(source)), source
    assert not list(ways_out("from sim.show.terminal.printer import say\nsay('a')"))
