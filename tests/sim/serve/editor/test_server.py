"""The language server, asked by a real client over its streams."""

import asyncio
import random
import sys
from collections.abc import Awaitable, Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
import sound
from lsprotocol import types
from places import ROOT
from pygls.lsp.client import LanguageClient

from sim.check.file_check import Job, check_file
from sim.check.settings import CheckSettings

WRONG = "// 😀 part\nB9900B0B39600GXNR1\nDD\n"
LONGEST_S = 60.0


class Editor(LanguageClient):
    """A client that keeps what is published of each text."""

    def __init__(self) -> None:
        super().__init__("test", "1")
        self.published: asyncio.Queue[types.PublishDiagnosticsParams] = asyncio.Queue()

        @self.feature(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        def _heard(params: types.PublishDiagnosticsParams) -> None:
            self.published.put_nowait(params)

    async def opens(self, uri: str, text: str) -> list[types.Diagnostic]:
        self.text_document_did_open(types.DidOpenTextDocumentParams(types.TextDocumentItem(uri, "3b", 1, text)))
        return await self.told()

    def changes(self, uri: str, version: int, text: str) -> None:
        self.text_document_did_change(
            types.DidChangeTextDocumentParams(
                types.VersionedTextDocumentIdentifier(version, uri),
                [types.TextDocumentContentChangeWholeDocument(text)],
            )
        )

    async def told(self) -> list[types.Diagnostic]:
        return list((await asyncio.wait_for(self.published.get(), LONGEST_S)).diagnostics)

    async def actions(self, uri: str, line: int, *only: types.CodeActionKind) -> list[types.CodeAction]:
        here = types.Range(types.Position(line, 0), types.Position(line, 99))
        context = types.CodeActionContext([], only=list(only) or None)
        asked = types.CodeActionParams(types.TextDocumentIdentifier(uri), here, context)
        return list(await self.text_document_code_action_async(asked) or ())  # type: ignore[arg-type]


OF_NEOVIM = types.ClientCapabilities(
    workspace=types.WorkspaceClientCapabilities(
        workspace_edit=types.WorkspaceEditClientCapabilities(document_changes=True)
    ),
    general=types.GeneralClientCapabilities(
        position_encodings=[types.PositionEncodingKind.Utf8, types.PositionEncodingKind.Utf16]
    ),
)


def session(
    work: Callable[[Editor], Awaitable[Any]],
    locale: str = "en",
    *options: str,
    capabilities: types.ClientCapabilities | None = None,
) -> Any:
    """What some work with a server comes to; the server ends when it is asked to."""

    async def run() -> Any:
        editor = Editor()
        await editor.start_io(sys.executable, "-m", "drycut", "lsp", *options, cwd=str(ROOT))
        asked = types.InitializeParams(capabilities=capabilities or types.ClientCapabilities(), locale=locale)
        await asyncio.wait_for(editor.initialize_async(asked), LONGEST_S)
        editor.initialized(types.InitializedParams())
        came = await asyncio.wait_for(work(editor), LONGEST_S)
        await editor.shutdown_async(None)
        editor.exit(None)
        await editor.stop()
        return came

    with ThreadPoolExecutor(1) as own:  # a browser of other tests may keep a loop in this thread
        return own.submit(asyncio.run, run()).result()


def applied(text: str, edits: list[types.TextEdit]) -> str:
    """A text with edits made, its lines cut in UTF-16."""
    lines = [line.encode("utf-16-le") for line in text.split("\n")]
    for edit in sorted(edits, key=lambda one: (one.range.start.line, one.range.start.character), reverse=True):
        start, end = edit.range.start, edit.range.end
        head = lines[start.line][: 2 * start.character].decode("utf-16-le")
        tail = lines[end.line][2 * end.character :].decode("utf-16-le")
        new = f"{head}{edit.new_text}{tail}".split("\n")
        lines[start.line : end.line + 1] = [line.encode("utf-16-le") for line in new]
    return "\n".join(line.decode("utf-16-le") for line in lines)


def codes(text: str) -> list[str]:
    return [finding.code for finding in check_file(Job("part.3b", text.encode(), CheckSettings())).findings]


def test_findings_stand_at_their_words_and_their_mends_mend(tmp_path: Path) -> None:
    uri = (tmp_path / "part.3b").as_uri()

    async def work(editor: Editor) -> None:
        (found,) = await editor.opens(uri, WRONG)
        assert (found.code, found.source, found.severity) == ("3B204", "drycut", types.DiagnosticSeverity.Error)
        assert (found.range.start, found.range.end) == (types.Position(1, 13), types.Position(1, 15))
        assert found.message.startswith("wrong count axis: the block counts on X")
        fix, everything = await editor.actions(uri, 1)
        assert (fix.title, fix.kind) == ("3B204: write GY, with J 39600", types.CodeActionKind.QuickFix)
        for action in (fix, everything):
            assert action.edit is not None
            assert codes(applied(WRONG, list((action.edit.changes or {})[uri]))) == []
        assert [action.kind for action in await editor.actions(uri, 0)] == [types.CodeActionKind.SourceFixAll]
        only = await editor.actions(uri, 1, types.CodeActionKind.QuickFix)
        assert [action.title for action in only] == ["3B204: write GY, with J 39600"]

    session(work)


@pytest.mark.deeper
def test_an_editor_that_counts_in_utf_8_is_given_edits_of_the_version_that_it_has(tmp_path: Path) -> None:
    uri = (tmp_path / "part.3b").as_uri()
    text = "（第一条；去）B9900B0B9900GXL1\n（圆）B9900B0B39600GYNR1\n（第二条；回）B9900B0B9900GXL2\nDD\n"

    async def work(editor: Editor) -> None:
        await editor.opens(uri, text)
        editor.changes(uri, 5, text + "\n")
        await editor.told()
        fix, _ = await editor.actions(uri, 2)
        assert fix.edit is not None
        (change,) = fix.edit.document_changes or ()
        assert isinstance(change, types.TextDocumentEdit)
        assert (change.text_document.uri, change.text_document.version) == (uri, 5)
        (edit,) = change.edits
        assert isinstance(edit, types.TextEdit)
        line = text.splitlines()[2].encode()
        at = edit.range
        assert at.start.line == at.end.line == 2
        mended = line[: at.start.character] + edit.new_text.encode() + line[at.end.character :]
        assert mended.decode() == "（第二条；回）B9900B0B9900GXL3"

    session(work, capabilities=OF_NEOVIM)


@pytest.mark.deeper
def test_it_speaks_the_language_of_the_editor_or_the_one_asked_for(tmp_path: Path) -> None:
    uri = (tmp_path / "part.3b").as_uri()

    async def work(editor: Editor) -> str:
        (found,) = await editor.opens(uri, WRONG)
        return found.message.splitlines()[0].partition(":")[0].partition("：")[0]

    assert session(work, "zh-CN") == "计数方向选错"
    assert session(work, "zh-CN", "--lang", "en") == "wrong count axis"


@pytest.mark.deeper
def test_changes_are_checked_and_a_closed_text_has_no_findings(tmp_path: Path) -> None:
    uri = (tmp_path / "part.3b").as_uri()

    async def work(editor: Editor) -> None:
        assert len(await editor.opens(uri, WRONG)) == 1
        for version in range(2, 9):
            editor.changes(uri, version, WRONG[: -version - 3])
        editor.changes(uri, 9, WRONG.replace("GXNR1", "GYNR1"))
        while await editor.told():
            pass  # of those before the last, if one was looked at
        editor.text_document_did_close(types.DidCloseTextDocumentParams(types.TextDocumentIdentifier(uri)))
        assert await editor.told() == []

    session(work)


@pytest.mark.deeper
def test_a_block_under_the_pointer_the_figures_and_the_layout(tmp_path: Path) -> None:
    uri = (tmp_path / "die.3b").as_uri()
    blocks = ("B0B300B300GYL2", "B300B0B600GYNR1", "D", "B5000B0B5000GXL1", "D", "B0B300B300GYL2")
    text = "".join(f"N   {number}: {block}\n" for number, block in enumerate(blocks, start=1)) + "DD\n"
    here = types.TextDocumentIdentifier(uri)

    async def work(editor: Editor) -> None:
        await editor.opens(uri, text)
        hover = await editor.text_document_hover_async(types.HoverParams(here, types.Position(1, 9)))
        assert hover is not None
        assert isinstance(hover.contents, types.MarkupContent)
        assert hover.contents.value.splitlines() == [
            "block **N2 (2)**: arc, 0.942 mm  ",
            "from 0.000, 0.300 to -0.600, 0.300 mm  ",
            "R 0.300 about -0.300, 0.300 mm, +180.000°",
        ]
        nowhere = await editor.text_document_hover_async(types.HoverParams(here, types.Position(7, 0)))
        assert nowhere is None
        outline = await editor.text_document_document_symbol_async(types.DocumentSymbolParams(here))
        assert [figure.name for figure in outline or ()] == ["figure 1: N1 to N2", "figure 2: N6 to N6"]
        first = (outline or [])[0]
        assert isinstance(first, types.DocumentSymbol)
        assert [block.name for block in first.children or ()] == ["N1", "N2"]
        options = types.FormattingOptions(4, insert_spaces=True)
        edits = await editor.text_document_formatting_async(types.DocumentFormattingParams(here, options))
        assert applied(text, list(edits or ())).splitlines()[1] == "N   2: B  300 B    0 B  600 GY NR1"

    session(work)


@pytest.mark.deeper
def test_settings_near_the_file_count_and_wrong_ones_are_told(tmp_path: Path) -> None:
    (tmp_path / "drycut.toml").write_text('root = true\nignore = ["3B204"]\n', "utf-8")
    (tmp_path / "odd").mkdir()
    (tmp_path / "odd" / "drycut.toml").write_text('root = true\nignored = ["3B204"]\n', "utf-8")

    async def work(editor: Editor) -> None:
        assert await editor.opens((tmp_path / "part.3b").as_uri(), WRONG) == []
        wrong, settings = await editor.opens((tmp_path / "odd" / "part.3b").as_uri(), WRONG)
        assert wrong.code == "3B204"
        assert settings.message.startswith("the settings near this program do not count: ")

    session(work)


@pytest.mark.deeper
def test_texts_that_are_no_programs_and_names_that_are_none_are_answered() -> None:
    texts = [
        "",
        "\ufeff",
        "\0\0",
        "hello",
        "\ufeffB9900B0B39600GXNR1\nDD\n",
        "B1" * 4000,
        "😀" * 99,
        "G01 X\udce4",
        WRONG * 3,
    ]

    async def work(editor: Editor) -> list[list[str]]:
        told = []
        for number, text in enumerate(texts):
            uri = f"untitled:{number}?<script>"
            told.append([str(found.code) for found in await editor.opens(uri, text)])
            here = types.TextDocumentIdentifier(uri)
            await editor.actions(uri, 0)
            await editor.text_document_hover_async(types.HoverParams(here, types.Position(0, 3)))
            await editor.text_document_document_symbol_async(types.DocumentSymbolParams(here))
            options = types.FormattingOptions(4, insert_spaces=True)
            await editor.text_document_formatting_async(types.DocumentFormattingParams(here, options))
        return told

    told = session(work)
    assert [found[:1] for found in told[:4]] == [["3B100"]] * 4
    assert told[4] == ["3B204"]


@pytest.mark.deeper
def test_sound_programs_are_silent(tmp_path: Path) -> None:
    texts = [sound.sound_program(random.Random(seed)).data.decode() for seed in range(3)]

    async def work(editor: Editor) -> list[list[types.Diagnostic]]:
        return [await editor.opens((tmp_path / f"{at}.3b").as_uri(), text) for at, text in enumerate(texts)]

    found = session(work)
    assert len(found) == 3
    assert [one for told in found for one in told if one.severity == types.DiagnosticSeverity.Error] == []


def test_words_of_blocks_are_painted_where_they_stand() -> None:
    text = "// 😀\nN1: B9900 B0 B39600 GX NR1 ; 0,0\nB5B6B6GYL1 b7b0b7gxl3\nDD\n"

    async def work(editor: Editor) -> None:
        await editor.opens("untitled:part.3b", text)
        asked = types.SemanticTokensParams(types.TextDocumentIdentifier("untitled:part.3b"))
        found = await editor.text_document_semantic_tokens_full_async(asked)
        assert found is not None
        line, column, painted = 0, 0, []
        for at in range(0, len(found.data), 5):
            by, start, length, kind, _ = found.data[at : at + 5]
            line, column = line + by, start + (0 if by else column)
            painted.append((text.split("\n")[line][column : column + length], kind))
        words = ["9900", "0", "39600", "GX", "NR1", "5", "6", "6", "GY", "L1", "7", "0", "7", "gx", "l3"]
        kinds = [0, 0, 0, 1, 3, *[0, 0, 0, 1, 2] * 2]
        assert painted == list(zip(words, kinds, strict=True))

    session(work)


def test_the_path_is_drawn_for_an_editor_that_asks() -> None:
    async def work(editor: Editor) -> None:
        await editor.opens("untitled:part.3b", WRONG)
        for theme in ("light", "dark"):
            asked = {"uri": "untitled:part.3b", "theme": theme}
            answer = await editor.protocol.send_request_async("drycut/path", asked)
            assert "<svg" in answer.svg
        editor.changes("untitled:part.3b", 2, "nothing")
        await editor.told()
        answer = await editor.protocol.send_request_async("drycut/path", {"uri": "untitled:part.3b"})
        assert answer.svg == ""

    session(work)
