"""The help of every command, in the language that it is asked for."""

import re
from collections.abc import Iterator

import click
import pytest
from command import run_inside

from parser.text.places import cells
from sim.cli import cli
from sim.cli.spoken import Spoken
from sim.show.texts.texts import texts

CHINESE = re.compile(r"[\u2e80-\u9fff]")
OF_ALL = {"usage", "options", "commands", "exit", "colon", "default", "required"}
OF_MESSAGES = {
    "error",
    "check-cache-own-checks",
    "check-cache-refused",
    "written",
    "compiling",
    "try-it",
    "not-expected",
} | {
    "no-option",
    "near",
    "missing",
    "no-choice",
    "bad-value",
}


def commands(group: click.Command, ctx: click.Context, key: str = "") -> Iterator[tuple[str, Spoken]]:
    """Every command with the name of its texts."""
    assert isinstance(group, Spoken)
    yield key or "drycut", group
    if isinstance(group, click.Group):
        for name in group.list_commands(ctx):
            inner = group.get_command(ctx, name)
            assert inner is not None
            yield from commands(inner, click.Context(inner, parent=ctx, info_name=name), f"{key}-{name}".strip("-"))


COMMANDS = dict(commands(cli, click.Context(cli, info_name="drycut")))


def flags(command: Spoken) -> list[str]:
    options = [one for one in command.get_params(click.Context(command)) if isinstance(one, click.Option)]
    return [max(one.opts, key=len).lstrip("-") for one in options if not one.hidden]


def helped(key: str, *options: str, language: str = "en_US.UTF-8") -> str:
    arguments = [] if key == "drycut" else key.split("-")
    done = run_inside(*arguments, "--help", *options, LC_ALL=language, COLUMNS="80")
    assert (done.returncode, done.stderr) == (0, b"")
    return done.stdout.decode()


@pytest.mark.parametrize("key", COMMANDS)
def test_every_option_of_a_command_is_told(key: str) -> None:
    known = texts("options")
    missing = [flag for flag in flags(COMMANDS[key]) if flag not in known and f"{key}-{flag}" not in known]
    assert missing == []
    assert key in texts("commands")


def test_no_text_is_left_of_what_there_is_not() -> None:
    told = {form for key, command in COMMANDS.items() for flag in flags(command) for form in (flag, f"{key}-{flag}")}
    assert set(texts("options")) - told == set()
    of_commands = {key + more for key in COMMANDS for more in ("", "-more", "-exit")}
    assert set(texts("commands")) - of_commands - OF_ALL - OF_MESSAGES == set()


@pytest.mark.parametrize("key", COMMANDS)
def test_help_is_in_the_language_of_the_locale_within_the_width(key: str) -> None:
    english, chinese = helped(key), helped(key, language="zh_CN.UTF-8")
    assert english.startswith(
        f"Usage: drycut{' ' * (key != 'drycut')}{'' if key == 'drycut' else key.replace('-', ' ')} "
    )
    assert chinese.startswith("用法：")
    assert not CHINESE.search(english)
    for line in chinese.splitlines():
        assert cells(line) <= 80, line
        told = re.split(r"\s{2,}", line.strip())[-1]
        is_text = not told.startswith(("-", "drycut", "cc", "LD_LIBRARY_PATH")) and len(told) > 40
        assert not is_text or CHINESE.search(told), line


@pytest.mark.parametrize("asked", [["--lang", "zh"], ["--lang=zh"]])
def test_the_language_that_is_asked_for_comes_before_that_of_the_locale(asked: list[str]) -> None:
    assert helped("check", *asked).startswith("用法：")
    assert run_inside(*asked, "check", "--help", LC_ALL="C.UTF-8").stdout.decode().startswith("用法：")
    english = run_inside("check", "--help", "--lang", "en", LC_ALL="zh_CN.UTF-8")
    assert english.stdout.decode().startswith("Usage:")


def test_a_language_that_there_is_not_is_bad_use() -> None:
    done = run_inside("check", "--lang", "fr", "a.3b")
    assert done.returncode == 2
    assert "'fr' is not one of 'en', 'zh'" in done.stderr.decode()


def test_an_error_in_the_use_is_framed_in_the_language_that_was_asked_for() -> None:
    assert run_inside("check", "--lang", "zh", "--jobs", "x", "none.3b").stderr.decode().startswith("drycut：错误：")


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["run", "part.3b", "--zzz"], "没有选项 --zzz。"),
        (["explain", "--lan"], "没有选项 --lan。是不是 --lang？"),
        (["run"], "缺少 PROGRAM|SCENARIO|FOLDER|GLOB...。"),
        (["run", "part.3b", "--side", "up"], "--side 只能是 left、right 之一。"),
        (["check", "a.3b", "--jobs", "0"], "--jobs：0 不在范围 x>=1 内。"),
        (["convert", "part.3b"], "缺少 --output。"),
    ],
)
def test_what_is_wrong_with_options_is_told_in_chinese(arguments: list[str], says: str) -> None:
    done = run_inside(*arguments, LC_ALL="zh_CN.UTF-8")
    assert (done.returncode, done.stderr.decode().strip()) == (2, f"drycut：错误：{says}")
