"""The language server: what an editor asks, answered of the texts that it has open.

Findings as diagnostics, and their certain mends as actions.
"""

import asyncio
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Final
from urllib.parse import unquote

from lsprotocol import types
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
from pygls.lsp.server import LanguageServer
from pygls.uris import to_fs_path

from parser import __version__
from parser.findings.catalogue import Language, texts
from parser.findings.codes import Severity
from parser.findings.findings import Edit, Finding
from sim.check.file_check import as_typed
from sim.serve.editor.coloured import TYPES, path_svg, tokens_of
from sim.serve.editor.shown import Places, Text, hover_of, layout_of, outline_of
from sim.show.draw.style import ThemeName
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
    return not kinds or any(kind.value == prefix or kind.value.startswith(f"{prefix}.") for prefix in kinds)


def _touch(this: Range, other: Range) -> bool:
    return not (this.end < other.start or other.end < this.start)


NAME: Final = "drycut"
PATH_REQUEST: Final = "drycut/path"
"""Of drycut's own: asked with the ``uri`` of a text and a ``theme``, ``light`` or ``dark``; answered with ``svg``."""
_PAUSE_S: Final = 0.03
"""Between two keys of who types fast lies more."""
_ACTIONS: Final = types.CodeActionOptions([types.CodeActionKind.QuickFix, types.CodeActionKind.SourceFixAll])


class _Texts:
    """The texts that an editor has open, read and checked once for each version."""

    def __init__(self, server: LanguageServer, language: Language | None) -> None:
        self._server, self._asked, self._locale = server, language, ""
        self._knows_versions = False
        self._open: dict[str, tuple[int | None, Text]] = {}

    def meet(self, params: types.InitializeParams) -> None:
        """The editor says in which language people use it, and whether its edits may be of one version of a text."""
        self._locale = params.locale or ""
        workspace = params.capabilities.workspace
        edits = workspace.workspace_edit if workspace else None
        self._knows_versions = bool(edits and edits.document_changes)

    def of(self, uri: str) -> Text:
        """A text as it stands now."""
        document = self._server.workspace.get_text_document(uri)
        version, known = self._open.get(uri, (None, None))
        if known is not None and version == document.version is not None:
            return known
        place = to_fs_path(uri)
        file = Path(place) if uri.startswith("file:") and place else None
        name = file.name if file else unquote(uri.rpartition("/")[2]) or "untitled"
        made = as_typed(name, file, document.source)
        encoding = self._server.workspace.position_encoding or types.PositionEncodingKind.Utf16
        of_version = document.version if self._knows_versions else None
        text = Text(uri, of_version, made, Places(made.lines, encoding), self._language)
        self._open[uri] = document.version, text
        return text

    def forget(self, uri: str) -> None:
        """A text is closed, or what it is checked with may be another."""
        self._open.pop(uri, None)

    @property
    def _language(self) -> Language:
        return self._asked or ("zh" if self._locale.lower().startswith("zh") else "en")


def language_server(language: Language | None) -> LanguageServer:
    """The server; its texts are in the language that is asked for, None for that of the editor."""
    server = LanguageServer(NAME, __version__, text_document_sync_kind=types.TextDocumentSyncKind.Full)
    texts = _Texts(server, language)
    _answer_changes(server, texts)
    _answer_questions(server, texts)
    return server


def _answer_changes(server: LanguageServer, texts: _Texts) -> None:
    def publish(uri: str) -> None:
        version = server.workspace.get_text_document(uri).version
        found = diagnostics_of(texts.of(uri))
        server.text_document_publish_diagnostics(types.PublishDiagnosticsParams(uri, found, version=version))

    @server.feature(types.INITIALIZE)
    def initialize(params: types.InitializeParams) -> None:
        texts.meet(params)

    @server.feature(types.TEXT_DOCUMENT_DID_OPEN)
    def did_open(params: types.DidOpenTextDocumentParams) -> None:
        publish(params.text_document.uri)

    @server.feature(types.TEXT_DOCUMENT_DID_CHANGE)
    async def did_change(params: types.DidChangeTextDocumentParams) -> None:
        """Of changes that come while one types, or while a large text is checked, only the last one is looked at."""
        await asyncio.sleep(_PAUSE_S)
        document = server.workspace.text_documents.get(params.text_document.uri)
        if document is not None and document.version == params.text_document.version:
            publish(params.text_document.uri)

    @server.feature(types.TEXT_DOCUMENT_DID_SAVE)
    def did_save(params: types.DidSaveTextDocumentParams) -> None:
        texts.forget(params.text_document.uri)  # settings near it may be others now
        publish(params.text_document.uri)

    @server.feature(types.TEXT_DOCUMENT_DID_CLOSE)
    def did_close(params: types.DidCloseTextDocumentParams) -> None:
        texts.forget(params.text_document.uri)
        server.text_document_publish_diagnostics(types.PublishDiagnosticsParams(params.text_document.uri, []))


def _answer_questions(server: LanguageServer, texts: _Texts) -> None:
    @server.feature(types.TEXT_DOCUMENT_SEMANTIC_TOKENS_FULL, types.SemanticTokensLegend(list(TYPES), []))
    def semantic_tokens(params: types.SemanticTokensParams) -> types.SemanticTokens:
        return types.SemanticTokens(tokens_of(texts.of(params.text_document.uri)))

    @server.feature(PATH_REQUEST)
    def path(params: Any) -> dict[str, str]:
        """The picture of a path as SVG, for an editor that shows it beside the text."""
        theme: ThemeName = "dark" if getattr(params, "theme", "") == "dark" else "light"
        return {"svg": path_svg(texts.of(str(params.uri)), theme)}

    @server.feature(types.TEXT_DOCUMENT_CODE_ACTION, _ACTIONS)
    def code_action(params: types.CodeActionParams) -> list[types.CodeAction]:
        kinds = [str(getattr(kind, "value", kind)) for kind in params.context.only or ()]
        return actions_of(texts.of(params.text_document.uri), params.range, kinds)

    @server.feature(types.TEXT_DOCUMENT_HOVER)
    def hover(params: types.HoverParams) -> types.Hover | None:
        return hover_of(texts.of(params.text_document.uri), params.position)

    @server.feature(types.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    def document_symbol(params: types.DocumentSymbolParams) -> list[types.DocumentSymbol]:
        return outline_of(texts.of(params.text_document.uri))

    @server.feature(types.TEXT_DOCUMENT_FORMATTING)
    def formatting(params: types.DocumentFormattingParams) -> list[types.TextEdit]:
        text = texts.of(params.text_document.uri)
        edits = layout_of(text.opened.program) if text.opened.program else ()
        return [types.TextEdit(text.places.range_of((edit.first, edit.past)), edit.text) for edit in edits]
