"""A mend is the same at every door: text, edit, bytes, geometry, in every encoding and with every line end.

A sound program of circles is damaged where its mend is certain. Each door must give the sound program again: the
editor's server in its three encodings, the page, ``--fix`` and ``--diff``. What applies the edits here knows neither
`Places` nor `Offsets`: it cuts encoded bytes.
"""

import random
import re
from typing import NamedTuple

import pytest
from depth import cases
from lsprotocol.types import CodeAction, CodeActionKind, Position, Range, TextDocumentEdit, TextEdit

from parser.program import load_program
from sim.check.file_check import as_typed, mended_text
from sim.check.settings import CheckSettings
from sim.cli.check.mends import for_tools
from sim.serve.editor.server import actions_of
from sim.serve.editor.shown import Places, Text
from sim.serve.page.answers import answer, file_of, read_file

UNITS = {"utf-8": ("utf-8", 1), "utf-16": ("utf-16-le", 2), "utf-32": ("utf-32-le", 4)}
WIDE = {code: code + 0xFEE0 for code in range(0x21, 0x7F)}
NARROW = {wide: code for code, wide in WIDE.items()}
EVERYWHERE = Range(Position(0, 0), Position(10_000, 0))


class Damaged(NamedTuple):
    """A damaged program, the sound one, and the radii of its circles in µm."""

    text: str
    sound: str
    radii_um: list[int]
    encoding: str
    newline: str


def damaged_program(seed: int) -> Damaged:
    """Circles led in and out along X, their words in any width, with remarks of any letters before and behind them."""
    rng = random.Random(seed)
    encoding = rng.choice(["utf-8", "utf-8-sig", "gb18030", "utf-16"])
    # GBK has both letters as well; but remarks of them alone look like Big5 (docs/3b.md).
    beyond = "" if encoding == "gb18030" else "é😀"
    newline = rng.choice(["\n", "\r\n", "\r", ""])
    radii = [rng.randrange(1_000, 40_000) for _ in range(rng.choice([1, 1, 2, 3]))]
    sound: list[str] = []
    wrong: list[str] = []
    hurt = rng.randrange(len(radii))
    for at, r in enumerate(radii):
        turn, _opposite = rng.choice([("NR1", "SR4"), ("SR4", "NR1")])
        right = [f"B{r}B0B{r}GXL1", f"B{r}B0B{4 * r}GY{turn}", f"B{r}B0B{r}GXL3"]
        slip = list(right)
        if at == hurt or rng.random() < 0.3:
            slip = rng.choice(
                [
                    [right[0], right[1].replace("GY", "GX"), right[2]],
                    [right[0].replace("GXL1", "GXL4"), *right[1:]],
                    [*right[:2], right[2].replace("GXL3", "GXL2")],
                ]
            )
        for good, bad in zip(right, slip, strict=True):
            wide = rng.random() < 0.4
            front = rng.choice(
                ["", "", "（第二条；回）", "(remark)", "N{0}: ", "Ｎ{0}： ", "　", "\t", f"（{beyond}）"]
            )
            front = front.format(len(sound) + 1)
            behind = rng.choice(["", "", " // 起点", f"//{beyond}直线", "（回）"])
            sound.append(front + (good.translate(WIDE) if wide else good) + behind)
            wrong.append(front + (bad.translate(WIDE) if wide else bad) + behind)
        if at + 1 < len(radii):
            sound += ["D", "B100000B0B100000GXL1", "D"]
            wrong += ["D", "B100000B0B100000GXL1", "D"]
    ends = [newline or rng.choice(["\n", "\r\n", "\r"]) for _ in range(len(sound) + 1)]
    lines = [[*of, "DD"] for of in (wrong, sound)]
    text, right_text = ("".join(line + end for line, end in zip(of, ends, strict=True)) for of in lines)
    return Damaged(text, right_text, radii, encoding, newline)


def folded(text: str) -> str:
    return text.translate(NARROW)


def ends_um(radii: list[int]) -> list[tuple[float, float]]:
    """Where the blocks end, by the drawing of the program."""
    found: list[tuple[float, float]] = []
    for at, r in enumerate(radii):
        x = 100_000.0 * at
        found += [(x + r, 0.0), (x + r, 0.0), (x, 0.0)]
        if at + 1 < len(radii):
            found.append((x + 100_000.0, 0.0))
    return found


def is_right(data: bytes, radii: list[int]) -> bool:
    found = load_program(data, "part.3b").toolpath.end_um
    expected = ends_um(radii)
    return len(found) == len(expected) and bool(abs(found - expected).max() < 1e-6)


def by_editor(text: str, edits: list[TextEdit], encoding: str) -> str:
    """A text with edits made, its lines cut in the units of an encoding."""
    name, size = UNITS[encoding]
    lines = [*re.findall(r"[^\r\n]*(?:\r\n|\r|\n)|[^\r\n]+", text), ""]

    def at(place: Position) -> int:
        before = "".join(lines[: place.line])
        return len(before) + len(lines[place.line].encode(name)[: size * place.character].decode(name))

    for edit in sorted(edits, key=lambda made: at(made.range.start), reverse=True):
        text = text[: at(edit.range.start)] + edit.new_text + text[at(edit.range.end) :]
    return text


def edits_of(action: CodeAction) -> list[TextEdit]:
    (change,) = action.edit.document_changes if action.edit and action.edit.document_changes else ()
    assert isinstance(change, TextDocumentEdit)
    assert change.text_document.version == 7
    return [edit for edit in change.edits if isinstance(edit, TextEdit)]


def by_page(file: bytes) -> bytes:
    """A file opened on a page, whose lines end with LF, the edits of all findings made in UTF-16, and saved."""
    opened = read_file(file)
    text = opened.text
    data = text.encode("utf-16-le")
    findings = answer("part.3b", None, text)["findings"]
    edits = sorted({tuple(edit) for finding in findings for edit in finding["edits"]}, reverse=True)
    for first, past, new in edits:
        data = data[: 2 * first] + new.encode("utf-16-le") + data[2 * past :]
    return file_of(opened, data.decode("utf-16-le"))


def patched(before: bytes, patch: bytes) -> bytes:
    """What ``patch`` makes of a content: hunks of whole lines, which end at a line feed."""
    old = re.findall(rb"[^\n]*\n|[^\n]+", before)
    made: list[bytes] = []
    at = 0
    rows = list(re.findall(rb"[^\n]*\n|[^\n]+", patch)[2:])
    for number, line in enumerate(rows):
        bare = number + 1 < len(rows) and rows[number + 1].startswith(b"\\")
        body = line[1:-1] if bare else line[1:]
        if line.startswith(b"@@"):
            first = int(line.split(b"-")[1].split(b",")[0]) - 1
            made += old[at:first]
            at = first
        elif line.startswith(b"+"):
            made.append(body)
        elif line.startswith((b"-", b" ")):
            assert old[at] == body
            made += [body] if line.startswith(b" ") else []
            at += 1
    return b"".join(made + old[at:])


def hold(seed: int) -> None:
    program = damaged_program(seed)
    data, right = program.text.encode(program.encoding), program.sound
    mended = mended_text(load_program(data, "part.3b"), CheckSettings())
    assert folded(mended.data.decode(program.encoding)) == folded(right)
    assert is_right(mended.data, program.radii_um)
    assert patched(data, for_tools("part.3b", data, mended.data)) == mended.data
    assert by_page(data) == mended.data
    typed = program.text if seed % 5 else "\ufeff" + program.text
    opened = as_typed("part.3b", None, typed)
    encoding = tuple(UNITS)[seed % 3]
    text = Text("file:///part.3b", 7, opened, Places(opened.lines, encoding), "en")
    *quick, everything = actions_of(text, EVERYWHERE, [])
    assert everything.kind == CodeActionKind.SourceFixAll
    for made in (edits_of(everything), [edit for action in quick for edit in edits_of(action)]):
        assert folded(by_editor(typed, made, encoding)).lstrip("\ufeff") == folded(right)


@pytest.mark.alike(1)
@pytest.mark.deep
@pytest.mark.parametrize("part", range(4))
def test_a_certain_mend_gives_the_sound_program_at_every_door(part: int) -> None:
    for seed in cases(5, 25_000):
        hold(4 * seed + part)


def test_a_full_width_sign_before_the_place_moves_no_edit() -> None:
    text = "（第一条；去）B9900B0B9900GXL1\n（圆）B9900B0B39600GYNR1\n（第二条；回）B9900B0B9900GXL2\nDD\n"
    opened = as_typed("part.3b", None, text)
    for encoding in UNITS:
        at = Text("file:///part.3b", 7, opened, Places(opened.lines, encoding), "en")
        (everything,) = actions_of(at, EVERYWHERE, [CodeActionKind.SourceFixAll])
        assert by_editor(text, edits_of(everything), encoding) == text.replace("L2", "L3")
