"""A finding in lines of text: what it says, and how to mend it."""

from parser.findings.catalogue import Language, texts
from parser.findings.findings import Finding
from sim.show.words import Words


def message(finding: Finding, language: Language) -> str:
    """What a finding says, with its block before it."""
    text = texts(finding, language).message
    return Words(language)("findings.block", block=finding.block, message=text) if finding.block else text


def hint(finding: Finding, language: Language) -> str:
    """``hint: write GY``: how to mend it; empty where its page has no hint."""
    text, say = texts(finding, language).hint, Words(language)
    return f"{say('findings.hint')}{say('findings.colon')}{text}" if text else ""
