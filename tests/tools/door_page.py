"""The reference of ``docs/python.md``, made from the door and the docstrings behind it; ``make pages`` renews it."""

import inspect
import re
import textwrap
from pathlib import Path
from typing import Any

import drycut

PAGE = Path(__file__).parents[2] / "docs" / "python.md"
_REFERENCE = re.compile(r"(<!-- made from the door by make pages -->\n).*?(<!-- end of the door -->)", re.DOTALL)
_FUNCTION = re.compile(r"<function (\w+) at [^>]*>")
_SECTION = re.compile(r"^(Attributes|Parameters)\n-+\n", re.MULTILINE)
_ENTRY = re.compile(r"^(\w[\w, ]*)\n((?:    .*\n?|\n)+)", re.MULTILINE)


def renewed(page: str) -> str:
    """The page with the reference as the door is now."""
    return _REFERENCE.sub(lambda found: found[1] + reference() + found[2], page)


def reference() -> str:
    """A heading, a signature and the docstring of each name."""
    return "".join(_told(name, getattr(drycut, name)) for name in drycut.__all__)


def _told(name: str, what: Any) -> str:
    lines = [f"### {name}", "", *_call(name, what)]
    text = inspect.getdoc(what) or ""
    head, *rest = _SECTION.split(text + "\n")
    lines += _paragraphs(head)
    for title, body in zip(rest[::2], rest[1::2], strict=True):
        entries = _ENTRY.findall(body)
        lines += [f"| {title[:-1].lower()} | is |", "|---|---|"]
        lines += [f"| `{of}` | {_plain(' '.join(told.split()))} |" for of, told in entries]
        lines += ["", *_paragraphs(_ENTRY.sub("", body))]
    return "\n".join(lines).rstrip() + "\n\n"


def _call(name: str, what: Any) -> list[str]:
    """How a function is called; what makes an object stands in its table."""
    if inspect.isclass(what):
        return []
    of = inspect.signature(what)
    bare = of.replace(
        parameters=[each.replace(annotation=inspect.Parameter.empty) for each in of.parameters.values()],
        return_annotation=inspect.Signature.empty,
    )
    called = _FUNCTION.sub(r"\1", str(bare))
    return ["```text", *textwrap.wrap(f"{name}{called}", 116, subsequent_indent="    "), "```", ""]


def _paragraphs(text: str) -> list[str]:
    lines = []
    for paragraph in re.split(r"\n\s*\n", text.strip()):
        if paragraph:
            told = _plain(" ".join(paragraph.split()))
            lines += [*textwrap.wrap(told, 118, break_long_words=False, break_on_hyphens=False), ""]
    return lines


def _plain(text: str) -> str:
    return text.replace("``", "`").replace("|", "\\|")


if __name__ == "__main__":
    PAGE.write_text(renewed(PAGE.read_text("utf-8")), "utf-8")
