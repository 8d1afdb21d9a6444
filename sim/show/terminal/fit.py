"""What a measured circle tells on the terminal: each parameter with its interval, or why there is none."""

from collections.abc import Iterable
from typing import Literal

from parser.findings.catalogue import Language
from sim.measure.fit.circle import CircleFit
from sim.measure.fit.corner import CornerFit
from sim.measure.fit.parameters import Parameter
from sim.measure.fit.piece import PieceFit
from sim.show.terminal.layout import paragraph, show, table
from sim.show.texts import Words


def print_corner(done: CornerFit, language: Language) -> None:
    """Print what a corner tells to stdout."""
    tell = Words(language)
    _print_parameters("title-corner", done.parameters, tell)
    paragraph(tell("fit.of-corner", places=f"{done.places:,}", rest=f"{done.residual_um:.3g}"))
    if done.lack:
        paragraph(tell("fit.lack", why=tell(f"fit.lack-{done.lack}")), "yellow")


def print_piece(done: PieceFit, language: Language) -> None:
    """Print what a piece tells to stdout."""
    tell = Words(language)
    _print_parameters("title-piece", done.parameters, tell)
    values = {"sizes": f"{done.sizes:,}", "places": f"{done.places:,}", "rest": f"{done.residual_um:.3g}"}
    paragraph(tell("fit.of-piece", **values))
    if done.left_out:
        paragraph(tell("fit.features-left-out", names=", ".join(done.left_out)), "cyan")
    if done.stepped:
        paragraph(tell("fit.features-stepped", names=", ".join(done.stepped)), "cyan")
    if done.lack:
        paragraph(tell("fit.lack", why=tell(f"fit.lack-{done.lack}")), "yellow")


def print_fit(done: CircleFit, language: Language, unnamed: Literal["", "unknown", "usual"]) -> None:
    """Print a fit to stdout; where nobody named its machine, what was taken for it: nothing, or the usual one."""
    tell = Words(language)
    _print_parameters("title", done.parameters, tell)
    turns = tell("fit.both" if len(done.senses) > 1 else "fit.ccw" if done.senses[0] > 0 else "fit.cw")
    values = {"places": f"{done.places:,}", "turns": turns, "rest": f"{done.residual_um:.3g}"}
    paragraph(tell("fit.of", **values))
    if done.left_out:
        paragraph(tell("fit.left-out", number=done.left_out), "cyan")
    if unnamed:
        paragraph(tell(f"fit.{unnamed}-machine"), "cyan")
    if done.lack:
        paragraph(tell("fit.lack", why=tell(f"fit.lack-{done.lack}")), "yellow")


def _print_parameters(title: str, parameters: Iterable[Parameter], tell: Words) -> None:
    heads = tuple(tell(f"fit.head-{name}") for name in ("parameter", "value", "interval"))
    rows = table(tell(f"fit.{title}"), heads, (1,))
    for parameter in parameters:
        rows.add_row(tell(f"fit.name-{parameter.name}"), *_numbers(parameter, tell))
    show(rows)


def _numbers(parameter: Parameter, tell: Words) -> tuple[str, str]:
    """The value, and its interval or why it is not determined."""
    value, least, most = parameter.value, parameter.least, parameter.most
    if value is None or least is None or most is None:
        return "–", tell(f"fit.why-{parameter.why}")
    by = 0.5 * (most - least)
    digits = 0 if by >= 20.0 else 1 if by >= 2.0 else 2 if by >= 0.2 else 3
    return f"{round(value, digits) + 0.0:,.{digits}f} {parameter.unit}".replace("-", "−"), f"± {by:.{digits}f}"
