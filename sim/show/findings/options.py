"""Choices that formats share."""

from typing import NamedTuple

from parser.findings.catalogue import Language


class Options(NamedTuple):
    """How to write results.

    Attributes
    ----------
    language
        Language of all texts.
    colour, quiet, stats
        Of the text format: with colours; no line for files without a finding and no summary; with a table of counts.
    """

    language: Language = "en"
    colour: bool = False
    quiet: bool = False
    stats: bool = False
