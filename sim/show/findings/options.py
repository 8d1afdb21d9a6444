"""Choices that formats share."""

from typing import NamedTuple

from parser.findings.catalogue import Language
from sim.show.terminal.wrap import WIDTH


class Options(NamedTuple):
    """How to write results.

    Attributes
    ----------
    language
        Language of all texts.
    colour, quiet, statistics
        Of the text format: with colours; no line for files without a finding and no summary; with a table of counts.
    width
        Of the text format: cells of a line.
    """

    language: Language = "en"
    colour: bool = False
    quiet: bool = False
    statistics: bool = False
    width: int = WIDTH
