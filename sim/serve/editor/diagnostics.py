"""Findings as diagnostics, and their certain mends as actions."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Final

from lsprotocol.types import (
    CodeAction,
    CodeActionKind,
    Diagnostic,
    DiagnosticSeverity,
    OptionalVersionedTextDocumentIdentifier,
    Range,
    TextDocumentEdit,
    TextEdit,
    WorkspaceEdit,
)

from parser.findings.catalogue import texts
from parser.findings.codes import Severity
from parser.findings.findings import Edit, Finding
from sim.serve.editor.places import Places, Text
from sim.show.texts import Words

SOURCE: Final = "drycut"
_SEVERITIES: Final[Mapping[Severity, DiagnosticSeverity]] = {
    Severity.ERROR: DiagnosticSeverity.Error,
    Severity.WARNING: DiagnosticSeverity.Warning,
    Severity.NOTE: DiagnosticSeverity.Information,
}


def diagnostics_of(text: Text) -> list[Diagnostic]:
    """A diagnostic for each finding, and one at the first line for settings that cannot be."""
    found = [_diagnostic(finding, text) for finding in text.opened.result.findings]
    if text.opened.wrong_settings:
        said = Words(text.language)("editor.settings", why=text.opened.wrong_settings)
        first = text.places.line_range(1)
        found.append(Diagnostic(first, said, severity=DiagnosticSeverity.Warning, source=SOURCE))
    return found


def actions_of(text: Text, asked_range: Range, kinds: Sequence[str]) -> list[CodeAction]:
    """Mends of the findings that a range touches; and of all that is certain, where such an action is asked for.

    `kinds` are the kinds that are asked for; empty for all.
    """
    actions = []
    if _wanted(CodeActionKind.QuickFix, kinds):
        actions += list(_quick_fixes(text, asked_range))
    if _wanted(CodeActionKind.SourceFixAll, kinds) and text.mends:
        title = Words(text.language)("editor.mend-all")
        actions.append(CodeAction(title, kind=CodeActionKind.SourceFixAll, edit=_edit(text, text.mends)))
    return actions


def _diagnostic(finding: Finding, text: Text) -> Diagnostic:
    said = texts(finding, text.language)
    message = "\n".join(filter(None, (f"{said.title}: {said.message}", said.hint)))
    return Diagnostic(
        _range(finding, text.places),
        message,
        severity=_SEVERITIES[finding.severity],
        code=finding.code,
        source=SOURCE,
    )


def _range(finding: Finding, places: Places) -> Range:
    """Of the words that are wrong; of a finding on the whole program its first line."""
    if finding.span[1] > finding.span[0]:
        return places.range_of(finding.span)
    return places.line_range(min(max(finding.line, 1), places.count))


def _quick_fixes(text: Text, asked_range: Range) -> Iterator[CodeAction]:
    for finding in text.opened.result.findings:
        if not finding.edits or not _touch(_range(finding, text.places), asked_range):
            continue
        said = texts(finding, text.language)
        yield CodeAction(
            f"{finding.code}: {said.hint or said.title}",
            kind=CodeActionKind.QuickFix,
            diagnostics=[_diagnostic(finding, text)],
            is_preferred=True,
            edit=_edit(text, finding.edits),
        )


def _edit(text: Text, edits: Sequence[Edit]) -> WorkspaceEdit:
    """Edits of a text; of one version of it where the editor knows versions, so that it refuses them for another."""
    made = [TextEdit(text.places.range_of((edit.first, edit.past)), edit.text) for edit in edits]
    if text.version is None:
        return WorkspaceEdit(changes={text.uri: made})
    of_version = OptionalVersionedTextDocumentIdentifier(text.uri, text.version)
    return WorkspaceEdit(document_changes=[TextDocumentEdit(of_version, [*made])])


def _wanted(kind: CodeActionKind, kinds: Sequence[str]) -> bool:
    """Whether a kind, or one that it is of, is asked for."""
    return not kinds or any(kind.value == asked or kind.value.startswith(f"{asked}.") for asked in kinds)


def _touch(this: Range, other: Range) -> bool:
    return not (this.end < other.start or other.end < this.start)
