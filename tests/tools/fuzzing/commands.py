"""Target `command`: command lines, their options as click tells them, over sound, damaged and hostile files.

A film and a window take longer than all the rest: `replay` is tried up to the program that it cannot read, and `run`
with one program or two.
"""

import contextlib
import random
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import pairwise
from pathlib import Path

import click
from places import SCENARIOS

from fuzzing.card_logs import make as fuzzed_log
from fuzzing.card_logs import seeds as logs
from fuzzing.dxf_text import fuzzed_dxf
from fuzzing.mutate import TEXTS, edited, number_text
from fuzzing.program_text import fuzzed_program
from fuzzing.ran import answer_of, broken_by, leftovers, ran
from fuzzing.setups import PROGRAM, make_machine, make_scenario, make_settings
from fuzzing.target import SEED, Input, Judged
from sim.cli import cli

_ARGUMENTS = {
    "card": ("part.log", "fuzz.log"),
    "explain": ("3B204", "3b301", "3B100", "3B999"),
    "compare": ("scenario", "part.3b", "drawing.dxf", "fuzz.dxf", "fuzz.3b"),
    "ballbar": ("part.3b",),
}
_WEIGHTS = {"check": 50, "card": 12, "explain": 10, "compare": 3, "run": 6, "draw": 3, "replay": 4, "ballbar": 2}
_NEVER = {"--watch", "--scheduler"}
"""Options that never come to an end, or ask a network."""
_MANY = {".", "*.3b", "**/*.3b"}
"""What leads to all programs there are."""
_SLOW = {"--size": ("thumbnail", "320x240", "64"), "--radius": ("0.1mm", "-1mm", "0mm")}
_USUAL = {
    "--machine": ("machine.toml", "dk7740", "fuzz.toml", "absent.toml"),
    **dict.fromkeys(("--select", "--ignore"), ("3B2", "3B204,3B3", "3b1", "", "9")),
    **dict.fromkeys(("--format", "--output-format"), ("text", "json", "sarif", "junit", "github", "gitlab", "concise")),
    "--drawing": ("drawing.dxf", "fuzz.dxf"),
    "--side": ("left", "right"),
}
_HOSTILE_NAMES = (
    "\x1b[31m.3b",
    "::error::x.3b",
    "##[error]x.3b",
    "\u202eb3.3b",
    "a\nb.3b",
    "加工.3b",
    "%0A.3b",
    "x y.3b",
)
_FILES = (
    *(
        "part.3b",
        "bad.3b",
        "part.4b",
        "empty.3b",
        "fuzz.3b",
        "fuzz.dxf",
        "fuzz.log",
        "fuzz.toml",
        "drawing.dxf",
        "part.log",
    ),
    *(
        "machine.toml",
        "drycut.toml",
        "scenario",
        "fuzzed",
        "absent.3b",
        "*.3b",
        "**/*.3b",
        "[",
        ".",
        "-",
        *_HOSTILE_NAMES,
    ),
)
_LENGTHS = (
    "0.1mm",
    "10um",
    "0.18mm",
    "0um",
    "-1mm",
    "1e9mm",
    "nanmm",
    "infmm",
    "5",
    "µm",
    "0.1in",
    "0.2mm,0.1mm",
    "1e999m",
)
_WORDS = (
    "dk7740",
    "left",
    "right",
    "card",
    "point-by-point",
    "3B2",
    "3B204,3B3",
    "text",
    "json",
    "CUT",
    "screen",
    "a4",
    "out",
)
_COLUMNS = ("80", "80", "80", "80", "0", "1", "-1", "x", "100000")
_LOCALES = ("C.UTF-8", "zh_CN.UTF-8", "C", "x" * 100)


def make(rng: random.Random) -> Input:
    """A command line, without the name of the program."""
    name = rng.choices(list(_WEIGHTS), list(_WEIGHTS.values()))[0]
    words = [name, *(("replay",) if name == "card" else ("--radius", "0.1mm") if name == "ballbar" else ())]
    command = _command(tuple(words[:2]) if name == "card" else (name,))
    options = [param for param in command.params if isinstance(param, click.Option) and not _NEVER & set(param.opts)]
    for option in rng.sample(options, min(len(options), rng.choice((0, 0, 1, 1, 2, 4)))):
        words += _given(rng, option)
    words += [_of_command(rng, name) for _ in range(rng.choice((0, 1, 1, 1, 1, 1, 2)))]
    if rng.random() < 0.05:
        words = edited(rng, words, lambda _: rng.choice(TEXTS))
    if name == "run":
        words = ["part.3b" if word in _MANY else word for word in words]
    return tuple(_safe(word) for word in _bounded(words))


def judge(data: Input, number: int, folder: Path) -> Judged:
    """A command ends with a word and an exit code of its own, prints what is well-formed, and leaves nothing behind."""
    assert isinstance(data, tuple)
    rng = random.Random(f"files:{SEED}:{number}")
    fill(folder, rng)
    done = ran(data, folder, COLUMNS=rng.choice(_COLUMNS), LC_ALL=rng.choice(_LOCALES))
    broken = [*broken_by(done, folder, _form(data)), *leftovers(folder)]
    return Judged(answer_of(done, folder), broken, f"exit {done.returncode or 0}")


def fill(folder: Path, rng: random.Random) -> None:
    """The files that commands name."""
    files: dict[str, bytes] = {
        **{"part.3b": PROGRAM.encode(), "bad.3b": b"B99B0B396GXNR1\nB1B2", "part.4b": b"B10B0B10B0GXL1\nDD\n"},
        **{"empty.3b": b"", "drawing.dxf": (SCENARIOS / "round-hole" / "drawing.dxf").read_bytes()},
        **{"part.log": logs()[0].encode(), "machine.toml": (SCENARIOS / "out-of-travel" / "machine.toml").read_bytes()},
        **{"fuzz.3b": fuzzed_program(rng)[:3000], "fuzz.dxf": fuzzed_dxf(rng)},
        **{"fuzz.log": _bytes(fuzzed_log(rng)), "fuzz.toml": _bytes(make_machine(rng))},
        **{"scenario/program.3b": PROGRAM.encode(), "scenario/scenario.toml": b'title = "x"\n'},
        **{"fuzzed/program.3b": PROGRAM.encode(), "fuzzed/scenario.toml": _bytes(make_scenario(rng))},
    }
    if rng.random() < 0.2:
        files["drycut.toml"] = _bytes(make_settings(rng))
    files[rng.choice(_HOSTILE_NAMES)] = PROGRAM.encode()
    for name, content in files.items():
        with contextlib.suppress(OSError, ValueError):  # names that the file system does not take
            (folder / name).parent.mkdir(exist_ok=True)
            (folder / name).write_bytes(content)


@cache
def _command(words: Sequence[str]) -> click.Command:
    found: click.Command | None = cli
    for word in words:
        assert isinstance(found, click.Group)
        found = found.get_command(click.Context(found), word)
    assert found is not None
    return found


def _given(rng: random.Random, option: click.Option) -> list[str]:
    """An option as it may be written: now and then twice, in one word, or without its value."""
    name = rng.choice((*option.opts, *option.secondary_opts))
    if option.is_flag:
        return [name] if rng.random() < 0.95 else [f"{name}={rng.choice(TEXTS)}"]
    value = _value(rng, option)
    what = rng.random()
    if what < 0.05:
        return [name]
    return [f"{name}={value}"] if what < 0.15 else [name, value]


def _value(rng: random.Random, option: click.Option) -> str:
    own = next((values for name, values in (_SLOW | _USUAL).items() if name in option.opts), None)
    if own is not None and (rng.random() < 0.9 or not _SLOW.keys().isdisjoint(option.opts)):
        return rng.choice(own)
    if rng.random() < 0.1:
        return rng.choice(TEXTS)
    if isinstance(option.type, click.Choice) and rng.random() < 0.9:
        return str(rng.choice(option.type.choices))
    if isinstance(option.type, click.Path):
        return _file(rng) if rng.random() < 0.3 else rng.choice(("out", "out.png", "out.svg", "a/b/c", "part.3b/x"))
    if option.type.name.startswith("length"):
        return rng.choice(_LENGTHS[:4] if rng.random() < 0.7 else _LENGTHS)
    return rng.choice((*_WORDS, *_LENGTHS, number_text(rng), _file(rng)))


def _of_command(rng: random.Random, name: str) -> str:
    """What a command is usually given."""
    if rng.random() < 0.3:
        return _file(rng)
    return rng.choice(_ARGUMENTS.get(name, ("part.3b", "bad.3b", "fuzz.3b", "part.4b", "scenario", "fuzzed", ".")))


def _file(rng: random.Random) -> str:
    return rng.choice(_FILES) if rng.random() < 0.9 else rng.choice(TEXTS)


def _safe(word: str) -> str:
    """The word, where it leads out of the folder one that stays, and where no command line can hold it another."""
    name, equals, value = word.rpartition("=")
    kept = "x/" if value.startswith(("/", "..", "\\")) else value
    return f"{name}{equals}{kept}".replace("\0", "\ufffd")[:20_000]


def _bounded(words: list[str]) -> Iterator[str]:
    """The words; a replay is given a program that is not there, and somewhere to write to."""
    yield from words[:1] if words[:1] != ["replay"] else ("replay", "absent.3b", "-o", "film.gif")
    yield from words[1:]


def _bytes(made: Input) -> bytes:
    assert isinstance(made, bytes)
    return made


def _form(words: Sequence[str]) -> str:
    """The format of what a command prints."""
    names = {word.partition("=")[0] for word in words}
    if {"-o", "--output-file"} & names:
        return "file"
    if "--diff" in names:
        return "diff"
    if {"--help", "-h", "-", "--show-files", "--show-settings"} & names:
        return "text"
    if words[:1] != ("check",):
        is_value = ("--search", "--json") in pairwise(words)
        return "json" if "--json" in words and not is_value else "text"
    given = [value for name, value in pairwise(words) if name == "--format"]
    given += [word.removeprefix("--format=") for word in words if word.startswith("--format=")]
    return given[0] if len(given) == 1 and "=" not in given[0] else "text"
