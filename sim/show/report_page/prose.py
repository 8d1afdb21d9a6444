"""What the catalogue's pages use of Markdown, as HTML: paragraphs, fenced text, ``code`` and **bold**."""

import re

from markupsafe import Markup, escape

_FENCED = re.compile(r"^```\w*\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_CODE = re.compile(r"`([^`]+)`")
_JOINT = re.compile(r"(?<=[^\x00-\x7f])\n(?=[^\x00-\x7f])")
"""A line's end between Chinese characters, which stand without a blank."""
_BOLD = re.compile(r"\*\*(.+?)\*\*", re.DOTALL)


def prose(markdown: str) -> Markup:
    """HTML of a text; all that is not Markdown of these kinds is escaped."""
    parts = _FENCED.split(markdown)  # every second one is fenced
    return Markup("").join(
        Markup("<pre>{}</pre>").format(part) if at % 2 else _paragraphs(part) for at, part in enumerate(parts)
    )


def _paragraphs(text: str) -> Markup:
    paragraphs = filter(None, map(str.strip, text.split("\n\n")))
    return Markup("").join(Markup("<p>{}</p>").format(inline(paragraph)) for paragraph in paragraphs)


def inline(text: str) -> Markup:
    """HTML of a text without paragraphs."""
    coded = _CODE.sub(r"<code>\1</code>", _JOINT.sub("", str(escape(text))))
    return Markup(_BOLD.sub(r"<strong>\1</strong>", coded))  # noqa: S704 - escaped just above
