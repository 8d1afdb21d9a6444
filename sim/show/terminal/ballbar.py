"""The table of a circular test on the terminal."""

from typing import Final

from sim.run.ballbar.circle import Ballbar
from sim.run.ballbar.turn import NAMES
from sim.show.circular_test import Row, figure_rows, loss_text, part_rows, setup_rows, um
from sim.show.terminal.layout import paragraph, show, table
from sim.show.words.words import Words

SAY: Final = Words("en")


def print_ballbar(ballbar: Ballbar, tolerance_um: float | None) -> None:
    """Print what was run, its figures and parts, what was lost, and the verdict to stdout."""
    shown = table(SAY("ballbar.title-table"))
    for group in _groups(ballbar):
        for row in group:
            shown.add_row(row.name, row.value)
        shown.add_section()
    show(shown)
    for loss in ballbar.losses:
        paragraph(SAY("ballbar.loss", loss=loss_text(*loss, SAY)), "red")
    no_turn = _no_turn(ballbar)
    if no_turn:
        paragraph(no_turn)
    passed = ballbar.passes(tolerance_um)
    verdict = SAY("ballbar.pass" if passed else "ballbar.fail") + _against(ballbar, tolerance_um)
    paragraph(verdict, "bold green" if passed else "bold red")


def _groups(ballbar: Ballbar) -> list[list[Row]]:
    groups = [setup_rows(ballbar, SAY)]
    if ballbar.measured is not None:
        figures, parts, interpolation_um = ballbar.measured
        groups.append([Row(SAY("ballbar.figures"), ""), *figure_rows(figures, SAY)])
        groups.append([Row(SAY("ballbar.parts"), ""), *part_rows(parts, interpolation_um, SAY)])
    return groups


def _no_turn(ballbar: Ballbar) -> str:
    """Why there are no figures, where there are none."""
    stopped = [SAY(f"ballbar.{NAMES[turn.sense]}") for turn in ballbar.turns if not turn.goes_round]
    return SAY("ballbar.no-figures", directions=SAY("ballbar.and").join(stopped)) if stopped else ""


def _against(ballbar: Ballbar, tolerance_um: float | None) -> str:
    """Circularity against its tolerance, where there are both."""
    if tolerance_um is None or ballbar.measured is None:
        return ""
    found = um(ballbar.measured.figures.circularity_um)
    return SAY("ballbar.allowed", found=found, allowed=um(tolerance_um))
