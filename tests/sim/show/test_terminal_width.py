"""Tables and texts in the width there is, whatever the environment says of it; nothing is cut off."""

import io
import re
from pathlib import Path

import pytest
from command import run_inside
from places import SCENARIOS

from parser.text.places import cells
from sim.show.terminal.layout import show, table
from sim.show.terminal.printer import say, styled

SHORT = "B500B0B500GXL1 B0B500B500GYL2 B500B0B500GXL3 B0B500B500GYL4 DD"


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    encoding = "utf-8"

    def isatty(self) -> bool:
        return True


def printed(monkeypatch: pytest.MonkeyPatch, stream: io.StringIO) -> str:
    """A table of hostile and long texts, and a line in colours."""
    monkeypatch.setattr("sys.stdout", stream)
    shown = table("title \x1b[31m " + "长" * 60, ("name", "value", "number"), right=(2,))
    shown.add_row("[bold]a[/bold] :warning:", "x" * 200 + " ::error ::y", "1")
    shown.add_row("##vso[a]b", "word " * 30, "2")
    show(shown)
    say(styled("\x1b[32mred", "bold red"))
    return stream.getvalue()


@pytest.mark.parametrize("columns", ["0", "1", "-5", "abc", "²", "9" * 5000, "80", ""])
def test_no_width_that_the_environment_tells_loses_a_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, columns: str
) -> None:
    monkeypatch.setenv("COLUMNS", columns)
    monkeypatch.setenv("LINES", columns)
    for stream, widest in ((io.StringIO(), 80), (Terminal(), 100)):
        text = re.sub(r"\x1b\[[\d;]*m", "", printed(monkeypatch, stream))
        assert max(map(cells, text.splitlines())) <= widest
        assert text.count("x") == 200
        assert text.count("word") == 30
        assert text.count("长") == 60
        assert "[bold]a[/bold]" in text.replace("\n", "")
        assert not re.search(r"\x1b|##vso\[|::error ::", text)


def test_every_table_of_a_command_fits_80_columns(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text(SHORT)
    for columns, *arguments in (
        ("0", "run", "part.3b"),
        ("200", "run", "part.3b"),
        ("0", "compare", SCENARIOS / "punch"),
    ):
        lines = run_inside(*arguments, cwd=tmp_path, COLUMNS=columns).stdout.decode().splitlines()
        assert 60 < max(map(cells, lines)) <= 80
        assert lines[-1].startswith("verdict: pass")


def test_colours_of_ours_reach_a_terminal_and_those_of_files_do_not(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("NO_COLOR", "FORCE_COLOR", "TERM"):
        monkeypatch.delenv(name, raising=False)
    ours = "\x1b[1;31m\ufffd[32mred\x1b[0m"
    assert ours in printed(monkeypatch, Terminal())
    assert "\x1b" not in printed(monkeypatch, io.StringIO())
    for name, value, stream, coloured in (
        *(("NO_COLOR", "1", Terminal(), False), ("NO_COLOR", "", Terminal(), True)),
        *(("TERM", "dumb", Terminal(), False), ("FORCE_COLOR", "1", io.StringIO(), True)),
    ):
        with monkeypatch.context() as changed:
            changed.setenv(name, value)
            assert ("\x1b" in printed(changed, stream)) is coloured, name
    monkeypatch.setenv("NO_COLOR", "1")
    monkeypatch.setenv("FORCE_COLOR", "1")
    assert "\x1b" not in printed(monkeypatch, Terminal())
