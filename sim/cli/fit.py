"""``drycut fit``."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Literal, NamedTuple

import click

from parser.findings.errors import Message
from sim.cli.ballbar import Speed
from sim.cli.spoken import Spoken, spoken, words
from sim.cli.spoken.values import FilePath, offer_machines

if TYPE_CHECKING:
    from sim.measure.fit.circle import CircleFit
    from sim.measure.fit.corner import CornerFit
    from sim.measure.fit.piece import PieceFit
    from sim.setup.machine.machine import Machine
    from sim.show.draw.style import ThemeName

_USUAL = "dk7740"


@click.command(cls=Spoken)
@click.argument("file", type=FilePath(path_type=Path), metavar="FILE.csv")
@click.option("--back", type=FilePath(path_type=Path, dir_okay=False), metavar="FILE.csv")
@click.option("--corner", is_flag=True)
@click.option("--limits", type=FilePath(path_type=Path), metavar="FILE.toml")
@click.option("--feed", type=Speed())
@click.option("--machine", metavar="NAME|FILE", shell_complete=offer_machines)
@click.option("-o", "--output", type=FilePath(path_type=Path), metavar="FILE.toml")
@click.option("--picture", type=FilePath(path_type=Path, dir_okay=False), metavar="FILE")
@click.option("--theme", type=click.Choice(["light", "dark"]), default="light", show_default=True)
@click.option("--json", "as_json", is_flag=True)
def fit(  # noqa: PLR0913, PLR0917 - click hands over each option by its name
    file: Path,
    back: Path | None,
    corner: bool,
    limits: Path | None,
    feed: float | None,
    machine: str | None,
    output: Path | None,
    picture: Path | None,
    theme: "ThemeName",
    as_json: bool,
) -> None:
    """Tell what a measured circle or piece says of a machine, or a corner of the wire.

    \b
    drycut fit circle.csv --feed 500mm/min --machine mine.toml
    drycut fit ccw.csv --back cw.csv -o mine.toml
    drycut fit corner.csv --corner --picture corner.png
    drycut fit piece.csv --machine dk7740 -o mine.toml
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from sim.measure.fit.rows import is_of_features

    wanted = _Wanted(file, back, limits, feed, machine, output, _Picture(picture, theme), as_json)
    if picture is not None:
        _refuse_picture(picture, (file, output))
    if corner:
        others = {"--back": back, "--feed": feed, "--machine": machine, "-o": output, "--limits": limits}
        _refuse(others, "not-with-corner")
        _tell_corner(wanted)
        return
    if output is not None and output.suffix.lower() != ".toml":
        raise click.BadParameter(Message("machine-is-toml", output=output), param_hint="-o")
    if feed is not None and feed <= 0.0:
        raise click.BadParameter(Message("not-above-0"), param_hint="--feed")
    if is_of_features(file):
        _refuse({"--back": back}, "not-of-a-piece")
        _tell_piece(wanted)
    else:
        _refuse({"--limits": limits}, "limits-of-a-piece")
        _tell_circle(wanted)


class _Picture(NamedTuple):
    """The picture of the fit as it is asked for; no file where none is."""

    file: Path | None
    theme: "ThemeName"

    def draw(self, fit: "CircleFit | CornerFit | PieceFit", measured: Path) -> None:
        """Write it, if it is asked for."""
        if self.file is None:
            return
        from parser.text.encoding import printable
        from sim.show.draw.sheet import SIZES_PX
        from sim.show.pictures.files import PictureFiles, write_pictures
        from sim.show.pictures.fit import FIT, FitSubject

        subject = FitSubject(fit, printable(measured.name))
        files = PictureFiles(self.file.parent, {FIT: self.file.name})
        write_pictures(subject, files, SIZES_PX["screen"], self.theme, spoken())


class _Wanted(NamedTuple):
    """What the command is given, by the names of its options."""

    file: Path
    back: Path | None
    limits: Path | None
    feed: float | None
    machine: str | None
    output: Path | None
    picture: _Picture
    as_json: bool

    def base(self) -> "Machine":
        """The machine that a new machine file begins with."""
        from sim.setup.machine.machine import load_machine

        return load_machine(self.machine or _USUAL)

    def finish(
        self, fit: "CircleFit | CornerFit | PieceFit", print_it: Callable[[], None], off_um: float = 0.0
    ) -> None:
        """Draw a fit, and print it, its JSON alone where that is wanted; `off_um` is how far a machine file is off."""
        from parser.text.encoding import printable
        from sim.measure.fit.model import document_text
        from sim.show.terminal.printer import write

        self.picture.draw(fit, self.file)
        if self.as_json:
            write(document_text(printable(str(self.file)), fit, words()), "json")
        else:
            print_it()
            _tell_written((self.output, self.picture.file), off_um)


def _refuse_picture(picture: Path, others: Iterable[Path | None]) -> None:
    """BadParameter for a picture of another kind, or in the place of another file of the command."""
    if picture.suffix.lower() not in {".png", ".svg"}:
        raise click.BadParameter(Message("neither-png-nor-svg", picture=picture), param_hint="--picture")
    for other in others:
        if other is not None and picture.resolve() == other.resolve():
            raise click.BadParameter(Message("written-over", file=picture), param_hint="--picture")


def _refuse(options: Mapping[str, object], why: str) -> None:
    """BadParameter for the first of some options that is given; `why` is the name of a message."""
    for option, value in options.items():
        if value is not None:
            raise click.BadParameter(Message(why), param_hint=option)


def _tell_written(written: Sequence[Path | None], off_um: float = 0.0) -> None:
    """Which files were written, and by how much the machine file is still off."""
    from sim.show.terminal.layout import paragraph
    from sim.show.terminal.printer import say

    if off_um:
        paragraph(words()("fit.still-off", off=f"{off_um:.2f}"), "yellow")
    names = [str(file) for file in written if file is not None]
    if names:
        say(words()("commands.written", names=", ".join(names)))


def _tell_corner(wanted: _Wanted) -> None:
    """What a measured corner says of the wire."""
    from sim.measure.fit.corner import fit_corner
    from sim.measure.fit.rows import read_circle
    from sim.show.terminal.fit import print_corner

    of_corner = fit_corner(read_circle(wanted.file))
    wanted.finish(of_corner, lambda: print_corner(of_corner, spoken()))


def _tell_piece(wanted: _Wanted) -> None:
    """What a test piece says of the machine: drycut's own, where no limits name the sizes of another one."""
    from sim.make.piece import piece_limits
    from sim.measure.accept.judge import read_piece
    from sim.measure.fit.piece import fit_piece
    from sim.setup.limits import load_limits
    from sim.show.terminal.fit import print_piece

    file, limits, output = wanted.file, wanted.limits, wanted.output
    of_piece = fit_piece(read_piece(file), load_limits(limits) if limits is not None else piece_limits())
    off_um = 0.0 if output is None else _write(of_piece, wanted.base(), wanted.feed, output)
    wanted.finish(of_piece, lambda: print_piece(of_piece, spoken()), off_um)


def _tell_circle(wanted: _Wanted) -> None:
    """What a measured circle says of the machine."""
    from sim.measure.fit.circle import fit_circle
    from sim.measure.fit.rows import read_circle
    from sim.show.terminal.fit import print_fit

    machine, output = wanted.machine, wanted.output
    # A machine file begins somewhere, and its own circle is fitted as the measured one was.
    base = None if machine is None and output is None else wanted.base()
    by_points = base is not None and base.controller.interpolation == "point-by-point"
    of_circle = fit_circle(read_circle(wanted.file, wanted.back), wanted.feed, by_points=by_points)
    off_um = 0.0 if base is None or output is None else _write(of_circle, base, wanted.feed, output)
    known: Literal["", "unknown", "usual"] = "" if machine is not None else "unknown" if base is None else "usual"
    wanted.finish(of_circle, lambda: print_fit(of_circle, spoken(), known), off_um)


def _write(done: "CircleFit | PieceFit", base: "Machine", feed_um_s: float | None, output: Path) -> float:
    """The machine file, with a line for what was measured of each of its keys; gives the µm it is off, if any."""
    from sim.base.files import staged
    from sim.cli.progress import StageProgress
    from sim.run.ballbar.fitted import ALIKE_UM, fitted_machine
    from sim.setup.machine.machine import machine_sections
    from sim.setup.toml.keys import toml_text

    with StageProgress("run-ccw", "run-cw") as progress:
        fitted = fitted_machine(base, done, feed_um_s, progress)
    off_um = fitted.off_um if fitted.off_um > ALIKE_UM else 0.0
    lines = [
        f"# {each.name}: {each.value:.3f} {each.unit}, {each.least:.3f} to {each.most:.3f} (95 %)\n"
        for each in done.parameters
        if each.name.startswith(("reversal", "squareness", "scale", "mean")) and each.value is not None
    ]
    if off_um:
        lines.append(f"# lost motion still differs by {off_um:.2f} µm from what was measured\n")
    text = "".join(lines) + f"# set so: {', '.join(fitted.keys)}\n" + toml_text(machine_sections(fitted.machine))
    with staged(output.parent, [output.name]) as stage:
        (stage / output.name).write_text(text, encoding="utf-8")
    return off_um
