"""Pages of codes and documents as data, and a search in them: ``drycut explain --json`` and ``--search``."""

import json
from collections.abc import Sequence
from typing import Annotated, Final, Literal, NamedTuple, TypedDict

from parser import __version__
from parser.documents import (
    Code,
    Document,
    SeverityName,
    Text,
    Version,
    matching,
    one_of,
)
from parser.findings.catalogue import LANGUAGES, Example, Language, example, page
from parser.findings.codes import CODES
from sim.show.findings.pages import severity_word
from sim.show.terminal.markdown import document, documents, title
from sim.show.texts import Words


class ExampleEntry(TypedDict):
    """A program that has the finding, what the check that shows it is given, and the program mended.

    Texts of the files that the options name stand under their names.
    """

    program: Text
    options: list[str]
    files: dict[str, Text]
    mended: Text


class CodeEntry(TypedDict):
    """The page of a code; texts are Markdown."""

    code: Code
    severity: SeverityName
    check: Annotated[str, matching(r"^check-[a-z-]+$")] | None
    title: Text
    why: Text
    mend: Text
    example: ExampleEntry | None


class DocumentEntry(TypedDict):
    """A document; its text, Markdown, where it was named."""

    name: Text
    title: Text
    text: Text | None


class ExplainDocument(TypedDict):
    """Pages of codes and documents, ``drycut explain --json``."""

    schema: Literal["drycut.explain/1"]
    drycut: Version
    language: Annotated[str, one_of("en", "zh")]
    codes: list[CodeEntry]
    documents: list[DocumentEntry]


EXPLAIN: Final = Document(ExplainDocument, "docs/check.md")


class Pages(NamedTuple):
    """Codes and names of documents, the likeliest first."""

    codes: tuple[str, ...]
    documents: tuple[str, ...]


def every_page() -> Pages:
    """All of them, in their order."""
    return Pages(tuple(sorted(CODES)), documents())


def pages_with(words: Sequence[str]) -> Pages:
    """Pages that have all the words, in whatever language and case; those first that have them in their titles."""
    wanted = [word.casefold() for word in words]
    return Pages(
        _ranked(sorted(CODES), {code: _of_code(code) for code in CODES}, wanted),
        _ranked(documents(), {name: _of_document(name) for name in documents()}, wanted),
    )


def found_text(found: Pages, language: Language) -> str:
    """A line for each page that was found, codes before documents, as Markdown."""
    rows = [(code, f"{page(code, language).title} ({severity_word(code, language)})") for code in found.codes]
    rows += [(name, title(name, language)) for name in found.documents]
    width = max(len(name) for name, _ in rows)
    lines = "\n".join(f"{name:{width}}  {of}" for name, of in rows)
    return f"## {Words(language)('findings.pages-found', n=len(rows))}\n```\n{lines}\n```\n"


def explain_text(found: Pages, language: Language, *, is_whole: bool) -> str:
    """Pages as JSON, in ASCII; with the texts of the documents where the answer is to be whole."""
    answer: ExplainDocument = {
        "schema": "drycut.explain/1",
        "drycut": __version__,
        "language": language,
        "codes": [_code(code, language) for code in found.codes],
        "documents": [
            {"name": name, "title": title(name, language), "text": document(name, language) if is_whole else None}
            for name in found.documents
        ],
    }
    return json.dumps(answer, indent=2) + "\n"


class _Texts(NamedTuple):
    """Titles, and all there is to read, in both languages and small letters."""

    titles: str
    whole: str


def _ranked(names: Sequence[str], texts: dict[str, _Texts], wanted: Sequence[str]) -> tuple[str, ...]:
    found = [name for name in names if all(word in texts[name].whole for word in wanted)]
    return tuple(sorted(found, key=lambda name: not all(word in texts[name].titles for word in wanted)))


def _of_code(code: str) -> _Texts:
    of = [page(code, language) for language in LANGUAGES]
    titles = " ".join([code, *(each.title for each in of)])
    return _Texts(titles.casefold(), " ".join([titles, *(f"{each.why} {each.mend}" for each in of)]).casefold())


def _of_document(name: str) -> _Texts:
    titles = " ".join([name, *(title(name, language) for language in LANGUAGES)])
    texts = [document(name, language) for language in LANGUAGES]
    return _Texts(titles.casefold(), " ".join([titles, *texts]).casefold())


def _code(code: str, language: Language) -> CodeEntry:
    of, check, excerpt = page(code, language), CODES[code].check, example(code)
    return {
        "code": code,
        "severity": CODES[code].severity.value,
        "check": str(check) if check else None,
        "title": of.title,
        "why": of.why.strip(),
        "mend": of.mend.strip(),
        "example": excerpt and _example(excerpt),
    }


def _example(of: Example) -> ExampleEntry:
    return {"program": of.program, "options": list(of.options), "files": dict(of.files), "mended": of.mended}
