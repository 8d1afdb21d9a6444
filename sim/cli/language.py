"""The language people read: asked for, or that of their locale."""

import os

from parser.findings.catalogue import LANGUAGES, Language


def chosen(asked: str | None) -> Language:
    """The language asked for; else Chinese where the locale is, else English (POSIX: LC_ALL, LC_MESSAGES, LANG)."""
    if asked in LANGUAGES:
        return asked
    locale = next((value for name in ("LC_ALL", "LC_MESSAGES", "LANG") if (value := os.environ.get(name))), "")
    return "zh" if locale.lower().startswith("zh") else "en"
