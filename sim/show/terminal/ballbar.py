"""The table of a circular test on the terminal."""

from parser.findings.catalogue import Language
from sim.run.ballbar.circle import Ballbar
from sim.run.ballbar.figures import NAMES
from sim.show.ballbar_rows import Row, figure_rows, loss_text, part_rows, setup_rows, um
from sim.show.terminal.layout import paragraph, show, table
from sim.show.texts.texts import Words


def print_ballbar(ballbar: Ballbar, tolerance_um: float | None, language: Language) -> None:
    """Print what was run, its figures and parts, what was lost, and the verdict to stdout."""
    tell = Words(language)
    shown_table = table(tell("ballbar.title-table"))
    for group in _groups(ballbar, tell):
        for row in group:
            shown_table.add_row(row.name, row.value)
        shown_table.add_section()
    show(shown_table)
    for loss in ballbar.losses:
        paragraph(tell("ballbar.loss", loss=loss_text(*loss, tell)), "red")
    no_turn = _no_turn(ballbar, tell)
    if no_turn:
        paragraph(no_turn)
    passed = ballbar.passes(tolerance_um)
    verdict = tell("ballbar.pass" if passed else "ballbar.fail") + _against(ballbar, tolerance_um, tell)
    paragraph(verdict, "bold green" if passed else "bold red")


def _groups(ballbar: Ballbar, tell: Words) -> list[list[Row]]:
    groups = [setup_rows(ballbar, tell)]
    if ballbar.measured is not None:
        figures, parts, interpolation_um = ballbar.measured
        groups.append([Row(tell("ballbar.figures"), ""), *figure_rows(figures, tell)])
        groups.append([Row(tell("ballbar.parts"), ""), *part_rows(parts, interpolation_um, tell)])
    return groups


def _no_turn(ballbar: Ballbar, tell: Words) -> str:
    """Why there are no figures, where there are none."""
    stopped = [tell(f"ballbar.{NAMES[turn.sense]}") for turn in ballbar.turns if not turn.goes_round]
    return tell("ballbar.no-figures", directions=tell("ballbar.and").join(stopped)) if stopped else ""


def _against(ballbar: Ballbar, tolerance_um: float | None, tell: Words) -> str:
    """Circularity against its tolerance, where there are both."""
    if tolerance_um is None or ballbar.measured is None:
        return ""
    found = um(ballbar.measured.figures.circularity_um)
    return tell("ballbar.allowed", found=found, allowed=um(tolerance_um))
