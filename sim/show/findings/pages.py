"""Pages of the catalogue as Markdown, for ``drycut explain`` and for the findings documents."""

from parser.findings.catalogue import Language, example, own_codes, page
from parser.findings.codes import CODES
from sim.show.terminal.markdown import documents, title
from sim.show.texts import Words

_OF_LAYER = slice(None, -2)
"""What the codes of a layer have in common: ``3B2`` of 3B204, ``ISO2`` of ISO204."""


def page_text(code: str, language: Language, level: int = 1) -> str:
    """Page of a code as Markdown, its title a heading of this level. KeyError where there is no such code."""
    of, say = page(code, language), Words(language)
    mend = f"{say('findings.page-mend')}\n{of.mend.strip()}"
    parts = [f"{'#' * level} {page_title(code, language)}", of.why.strip(), mend]
    excerpt = example(code)
    if excerpt:
        key = "findings.page-example-with" if excerpt.options else "findings.page-example"
        head = say(key, options=" ".join(excerpt.options))
        named = [f"`{name}`:\n{_fenced(text)}" for name, text in excerpt.files.items()]
        mended = f"{say('findings.page-mended')}\n{_fenced(excerpt.mended)}"
        parts += [f"{head}\n{_fenced(excerpt.program)}", *named, mended]
    return "\n\n".join(parts) + "\n"


def page_title(code: str, language: Language) -> str:
    """``3B204: wrong count axis (error)``."""
    title, severity = page(code, language).title, severity_word(code, language)
    return Words(language)("findings.page-title", code=code, title=title, severity=severity)


def list_text(language: Language) -> str:
    """Every code with its severity and title, by layer, and every document with its title, as Markdown."""
    say = Words(language)
    codes = [f"## {title}\n{_fenced(_title_lines(codes, language))}" for title, codes in layers(language)]
    rows = "\n".join(f"{name:{max(map(len, documents()))}}  {title(name, language)}" for name in documents())
    return "\n\n".join([*codes, f"## {say('findings.documents')}\n{_fenced(rows)}"]) + "\n"


def layers(language: Language) -> tuple[tuple[str, tuple[str, ...]], ...]:
    """Titles of the layers, each with its codes."""
    own = own_codes()
    ours = [code for code in sorted(CODES) if code not in own]
    names = sorted({code[_OF_LAYER] for code in ours})
    of_drycut = tuple(
        (Words(language)(f"findings.layer-{name}"), tuple(code for code in ours if code[_OF_LAYER] == name))
        for name in names
    )
    return (*of_drycut, *([(Words(language)("findings.layer-own"), own)] if own else []))


def severity_word(code: str, language: Language) -> str:
    """Severity of a code, for people."""
    return Words(language)(f"findings.{CODES[code].severity}")


def _title_lines(codes: tuple[str, ...], language: Language) -> str:
    width = max(len(severity_word(code, language)) for code in CODES)
    return "\n".join(f"{code}  {severity_word(code, language):{width}}  {page(code, language).title}" for code in codes)


def _fenced(program: str) -> str:
    return f"```\n{program.strip()}\n```"
