"""``drycut class``."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from parser.findings.errors import Message, did_you_mean
from sim.cli.spoken import SpokenGroup, spoken, words
from sim.cli.spoken.values import FilePath

if TYPE_CHECKING:
    from sim.teach.marking import ClassResult


@click.group(name="class", cls=SpokenGroup)
def lesson() -> None:
    """Lessons for a class: one page that marks itself, hand-ins, and the marks of all."""


@lesson.command()
@click.argument("file", type=FilePath(path_type=Path, dir_okay=False), metavar="LESSON.toml")
@click.option("-o", "--output", type=FilePath(path_type=Path, dir_okay=False), required=True, metavar="FILE.html")
@click.option("--scorm", type=FilePath(path_type=Path, dir_okay=False), metavar="FILE.zip")
def make(file: Path, output: Path, scorm: Path | None) -> None:
    """Write the page of a lesson: one file that needs no network and no install.

    \b
    drycut class make lesson.toml -o lesson.html
    drycut class make lesson.toml -o lesson.html --scorm lesson.zip
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.jobs.lessons import lesson_into, lesson_of
    from sim.show.terminal.printer import say

    _refuse_other(output, ".html", "lesson-is-html")
    if scorm is not None:
        _refuse_other(scorm, ".zip", "scorm-is-zip")
    ready = lesson_of(file)
    size = lesson_into(ready, output, scorm)
    head = ready.lesson
    title = head.title.zh if spoken() == "zh" else head.title.en
    values = {"exercises": len(head.exercises), "points": f"{head.points:g}", "kilobytes": f"{size / 1000.0:.0f}"}
    say(words()("class.made", title=title, **values))
    say(words()("commands.written", names=", ".join(str(path) for path in (output, scorm) if path is not None)))


def _refuse_other(path: Path, suffix: str, message: str) -> None:
    if path.suffix.lower() != suffix:
        raise click.BadParameter(Message(message, file=path))


@lesson.command()
@click.argument("file", type=FilePath(path_type=Path, dir_okay=False), metavar="LESSON.toml")
@click.argument("folder", type=FilePath(path_type=Path, file_okay=False), metavar="FOLDER")
@click.option("-o", "--output", type=FilePath(path_type=Path, file_okay=False), metavar="DIR")
@click.option("--json", "as_json", is_flag=True)
def mark(file: Path, folder: Path, output: Path | None, as_json: bool) -> None:
    """Mark what a class handed in: answers are marked again, whatever marks a file claims.

    \b
    drycut class mark lesson.toml handed-in/ -o marks/
    drycut class mark lesson.toml handed-in/ --json
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.jobs.class_marks import class_result, marks_into
    from sim.jobs.lessons import lesson_of
    from sim.show.terminal.printer import say, write
    from sim.teach.marks_document import marks_text

    if output is None and not as_json:
        raise click.UsageError(Message("class-output-or-json"))
    ready = lesson_of(file)
    result = class_result(ready, folder)
    if output is not None and result.marks:
        marks_into(result, output)
    if as_json:
        write(marks_text(result), "json")
    _tell(result, folder, quiet=as_json)
    if output is not None and result.marks and not as_json:
        say(words()("commands.written", names=f"{output}/ index.html, marks.csv, marks.xlsx, pupil-0001.html …"))
    raise click.exceptions.Exit(0 if result.marks else 1)


def _tell(result: "ClassResult", folder: Path, *, quiet: bool) -> None:
    """Say how a class did, and what is to be looked at."""
    from sim.show.terminal.printer import say

    say_, marks = words(), result.marks
    for each in result.unread:
        say(say_("class.told-unread", name=each.name, why=say_(f"class.why-{each.why}")), err=True)
    for mark in marks:
        for key, is_there in (("told-changed", mark.is_changed), ("told-other", mark.is_of_other)):
            if is_there:
                say(say_(f"class.{key}", name=f"{mark.group} {mark.name}".strip()), err=True)
    for pair in result.alike:
        this, other = marks[pair.this].name, marks[pair.other].name
        say(say_("class.told-alike", this=this, other=other, count=pair.answers), err=True)
    if not marks:
        say(say_("class.nobody", folder=folder), err=True)
    elif not quiet:
        mean = sum(mark.sum for mark in marks) / len(marks)
        title = result.title.zh if spoken() == "zh" else result.title.en
        values = {"pupils": len(marks), "mean": f"{mean:.1f}", "points": f"{result.most:g}"}
        say(say_("class.told", title=title, **values))


@lesson.command()
@click.argument("name", required=False, metavar="[NAME]")
@click.option("-o", "--output", type=FilePath(path_type=Path, file_okay=False), metavar="DIR")
def example(name: str | None, output: Path | None) -> None:
    """Write a lesson that comes with drycut, with all its files, to use or to change.

    \b
    drycut class example
    drycut class example 1-first-blocks -o first/
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.jobs.lessons import example_lesson, lesson_example_into, lesson_names
    from sim.show.terminal.printer import say

    names = lesson_names()
    if name is None:
        wide = max(map(len, names)) + 2
        for each in names:
            title = example_lesson(each).title
            say(each.ljust(wide) + (title.zh if spoken() == "zh" else title.en))
        return
    if name not in names:
        hint = did_you_mean(name, names, Message("known-keys", names=", ".join(names)))
        raise click.UsageError(Message("no-lesson", name=name, hint=hint))
    folder = output or Path(name)
    if folder.exists():
        raise click.BadParameter(Message("example-is-there", folder=folder), param_hint="-o")
    written = lesson_example_into(folder, name)
    say(words()("commands.written", names=f"{folder}/ {', '.join(written)}"))
