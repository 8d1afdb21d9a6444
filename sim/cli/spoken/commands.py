"""Commands whose help stands in ``commands.toml`` and ``options.toml``, in the language that a process speaks.

Commands and groups of them whose help stands in ``commands.toml`` and ``options.toml``, in both languages.

What a command does is the text of its name, ``run`` or ``card-run``; that with ``-more`` says more, that with ``-exit``
tells its exit codes. An option has the text of its flag without dashes, ``thickness``, or one with the command before
it, ``run-thickness``, where it means something of its own there. Examples need no words: they are the last paragraph of
a command's docstring.

The help of a command in lines of a terminal: wide characters take two cells, and Chinese has no blanks to break at.

click counts characters, and breaks lines at blanks alone.

The language of a process: that which its command was asked for, else that of the locale.

What click says of wrong options and arguments, in the language of the command; it knows English alone.
"""

import copy
import inspect
import os
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Final

import click

from parser.findings.catalogue import LANGUAGES, Language, in_language
from parser.findings.errors import Message, did_you_mean
from parser.text.places import cells
from sim.show.terminal.wrap import wrapped
from sim.show.texts import Words
from sim.show.texts.texts import texts

OPTION: Final = "--lang"


class _Tongue:
    """What a command was asked for; threads of the process, such as that of the progress, share it."""

    chosen: Language | None = None


_TONGUE: Final = _Tongue()


def spoken() -> Language:
    """The language in which the command speaks."""
    return _TONGUE.chosen or of_locale()


def words() -> Words:
    """The texts in that language."""
    return Words(spoken())


def speak_as_asked(arguments: Sequence[str]) -> None:
    """Take the language from the arguments of a command: it holds for its help and for errors in them, too."""
    languages = [after for before, after in pairwise(arguments) if before == OPTION]
    joined = [argument.removeprefix(f"{OPTION}=") for argument in arguments if argument.startswith(f"{OPTION}=")]
    _TONGUE.chosen = next((language for language in LANGUAGES if language in {*languages, *joined}), None)


def of_locale() -> Language:
    """Chinese where the locale is, else English (POSIX: LC_ALL, LC_MESSAGES, LANG)."""
    locale = next((value for name in ("LC_ALL", "LC_MESSAGES", "LANG") if (value := os.environ.get(name))), "")
    return "zh" if locale.lower().startswith("zh") else "en"


def localised(message: str) -> str:
    """A text in the language of the command, where it is a message; what a library says stays as it is."""
    return str(in_language(message, spoken()))


def complaint(error: click.ClickException) -> str:
    """The message of an error."""
    if spoken() == "en":
        return error.format_message()
    tell = words()
    if isinstance(error, click.NoSuchOption):
        complaint_text = tell("commands.no-option", name=error.option_name)
        near = ", ".join(error.possibilities or ())
        return complaint_text + (tell("commands.near", names=near) if near else "")
    if isinstance(error, click.MissingParameter):
        return tell("commands.missing", name=_named(error))
    if isinstance(error, click.BadParameter) and isinstance(getattr(error.param, "type", None), click.Choice):
        choices = tell("phrases.comma").join(map(str, error.param.type.choices))  # type: ignore[union-attr]  # told by getattr
        return tell("commands.no-choice", name=_named(error), choices=choices)
    if isinstance(error, click.BadParameter) and (error.param or error.param_hint):
        return tell("commands.bad-value", name=_named(error), why=localised(error.message))
    return localised(error.message)


def _named(error: click.BadParameter) -> str:
    """What the command line calls a parameter."""
    if error.param_hint is not None:
        return error.param_hint if isinstance(error.param_hint, str) else " / ".join(error.param_hint)
    if isinstance(error.param, click.Option):
        return max(error.param.opts, key=len)
    return str(getattr(error.param, "metavar", None) or "")


_MOST_LEFT = 30  # cells of the left column; a longer name stands on a line of its own


class Formatter(click.HelpFormatter):
    """Writes usage, paragraphs and lists of two columns."""

    def write_usage(self, prog: str, args: str = "", prefix: str | None = None) -> None:
        """How the command is called."""
        head = words()("commands.usage") if prefix is None else prefix
        self._lines(wrapped(args, self.width, head=f"{head}{prog} "))

    def write_heading(self, heading: str) -> None:
        """A heading, with a colon."""
        self._lines([f"{heading}{words()('commands.colon')}"])

    def write_text(self, text: str) -> None:
        """A paragraph, or a line that is kept."""
        indent = " " * self.current_indent
        self._lines(wrapped(text, self.width, head=indent, indent=indent))

    def write_dl(self, rows: Iterable[tuple[str, str]], col_max: int = _MOST_LEFT, col_spacing: int = 2) -> None:
        """A list of two columns; what is behind a long name begins on the next line."""
        shown_rows, indent = list(rows), " " * self.current_indent
        left = min(max((cells(name) for name, _ in shown_rows), default=0), col_max) + col_spacing
        for name, text in shown_rows:
            head = indent + name + " " * (left - cells(name))
            if cells(name) > left - col_spacing:
                self._lines([indent + name])
                head = indent + " " * left
            self._lines(wrapped(text, self.width, head=head))

    def _lines(self, lines: Sequence[str]) -> None:
        self.write("".join(f"{line}\n" for line in lines))


_KEEPS_LINES: Final = "\b"
"""Before a paragraph whose lines click keeps."""


class _Context(click.Context):
    formatter_class = Formatter


class Spoken(click.Command):
    """A command with ``--lang``, whose help is in the language that it was asked for."""

    context_class = _Context

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Take the language first: errors in the arguments are told in it."""
        if any(argument.startswith(OPTION) for argument in args) or ctx.parent is None:
            speak_as_asked(args)
        takes_more, ctx.allow_extra_args = ctx.allow_extra_args, True
        try:
            more = super().parse_args(ctx, args)
        except click.BadOptionUsage as error:
            raise click.BadOptionUsage(error.option_name, self._misused(ctx, error.option_name), ctx) from None
        if more and not takes_more and not ctx.resilient_parsing:
            code = "extra-arguments" if len(more) > 1 else "extra-argument"
            ctx.fail(Message(code, arguments=" ".join(more)))
        return more

    def _misused(self, ctx: click.Context, name: str) -> Message:
        """What is wrong with an option: it lacks its value, or is a flag and has one."""
        options = (param for param in self.get_params(ctx) if isinstance(param, click.Option))
        flags = {flag for option in options if option.is_flag for flag in (*option.opts, *option.secondary_opts)}
        return Message("option-with-value" if name in flags else "option-without-value", option=name)

    def get_params(self, ctx: click.Context) -> list[click.Parameter]:
        """Its own, ``--lang``, and the help."""
        *own, help_option = super().get_params(ctx)
        return [*own, *([] if any(each.name == "lang" for each in own) else [_lang()]), help_option]

    def get_short_help_str(self, limit: int = 0) -> str:
        """What the command does."""
        return words()(f"commands.{_key(self)}")

    def format_usage(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """How it is called."""
        formatter.write_usage(ctx.command_path, " ".join(self.collect_usage_pieces(ctx)))

    def format_help_text(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """What it does, its exit codes, and examples."""
        with formatter.indentation():
            for paragraph in _paragraphs(_key(self)):
                formatter.write_paragraph()
                formatter.write_text(paragraph)
            if examples := _examples(self):
                formatter.write_paragraph()
                for line in examples:
                    formatter.write_text(line)

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Its options."""
        rows = [row for param in self.get_params(ctx) if (row := _row(self, param, ctx)) is not None]
        with formatter.section(words()("commands.options")):
            formatter.write_dl(rows)


class SpokenGroup(Spoken, click.Group):
    """A group of such commands; of those in it, it tells what their texts say, and imports none for that."""

    command_class = Spoken

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """The command that is named. UsageError, with those of names like it, where there is none."""
        if args[0] not in self.list_commands(ctx) and args[0][:1] != "-":
            hint = did_you_mean(args[0], self.list_commands(ctx), Message("help-lists-commands"))
            if Path(args[0]).exists():
                hint = Message("did-you-mean", name=f"check {args[0]}")
            raise click.UsageError(Message("no-such-command", name=args[0], hint=hint))
        return super().resolve_command(ctx, args)

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Its options, and the commands in it."""
        super().format_options(ctx, formatter)
        self.format_commands(ctx, formatter)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """The commands in it."""
        before = "" if ctx.parent is None else f"{_key(self)}-"
        names = self.list_commands(ctx)
        with formatter.section(words()("commands.commands")):
            formatter.write_dl([(name, words()(f"commands.{before}{name}")) for name in names])


def _key(command: click.Command) -> str:
    """Name of the texts of a command: that of its group stands before it where that is not the whole."""
    ctx = click.get_current_context(silent=True)
    if ctx is None or ctx.command is not command or ctx.parent is None:
        return command.name or ""
    return "-".join(ctx.command_path.split()[1:])


def _paragraphs(key: str) -> Iterator[str]:
    known, say = texts("commands"), words()
    yield say(f"commands.{key}")
    if f"{key}-more" in known:
        yield say(f"commands.{key}-more")
    if f"{key}-exit" in known:
        yield say("commands.exit") + say(f"commands.{key}-exit")


def _examples(command: click.Command) -> list[str]:
    last = inspect.cleandoc(command.help or "").split("\n\n")[-1]
    return last.split("\n")[1:] if last.startswith(_KEEPS_LINES) else []


def _row(command: click.Command, option: click.Parameter, ctx: click.Context) -> tuple[str, str] | None:
    """Flags of an option and what it means, its default and bounds behind it; None for what is not shown."""
    if not isinstance(option, click.Option) or option.hidden:
        return None
    spoken = copy.copy(option)
    spoken.help = _option_text(_key(command), max(option.opts, key=len).lstrip("-"))
    record = spoken.get_help_record(ctx)
    if record is None:
        return None
    flags, meaning = record
    for extra, key in (("default: ", "commands.default"), ("required", "commands.required")):
        meaning = meaning.replace(f"[{extra}", f"[{words()(key)}")
    return flags, meaning


def _option_text(key: str, name: str) -> str:
    own = f"{key}-{name}"
    return words()(f"options.{own if own in texts('options') else name}")


@cache
def _lang() -> click.Option:
    return click.Option([OPTION], type=click.Choice(["en", "zh"]), expose_value=False)
