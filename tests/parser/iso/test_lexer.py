"""Text to words: all ways of writing them, each with its place, and what is none of them."""

import random

import numpy as np
import pytest

from parser.findings.findings import edited
from parser.iso.listing import lexer
from parser.iso.listing.lexer import read_listing
from parser.iso.listing.lines import PlainWords, plain_words
from parser.iso.listing.listing import Form, Listing
from parser.text.source import Codes

NO_WORDS = plain_words(np.frombuffer(b" ", dtype=np.uint8))
PIECES = [
    *"GXYIJNMHDO019 \t\n\r;:/(),.-+=#%?gx\0\x1a\u3000\xa0",
    *("\r\n", "N10 ", "G01 X1.5 Y-.5\n", "X 1 ", "X1 0", "X1..2", "X- 5", "X+200", "G91G92 X115000 Y-10000\n"),
    *("H001=110\n", "H1 =.00995 + H175\n", "C001 = 012 014\n", "QAIC(2,1,0.1250);\n", "(a remark)", "(open\n", " ;\n"),
    *(
        "% TAPE\n",
        "%\n",
        "M02\n",
        "O0027\n",
        "; G01 X1\n",
        "TITLE\n",
        "#100=1\n",
        "F#61",
        "G01X1Y1:G01X2Y2\n",
        "Ｇ０１",
        "加工",
    ),
    *("99999999999999999", "0.12345678901234567", "X.", "X+.5", "/N1 G01\n"),
]


def words_of(listing: Listing) -> list[list[tuple[str, float, int]]]:
    """Letter, number and decimals of the words of each block."""
    words = listing.words
    rows = [(chr(row[0]), *row[1:]) for row in zip(*(column.tolist() for column in words[:3]), strict=True)]
    return [rows[first:past] for first, past in zip(listing.blocks.word[:-1], listing.blocks.word[1:], strict=True)]


def told(listing: Listing) -> list[tuple[str, int, int, str]]:
    """Code, line, column and text of each finding."""
    return [(found.code, found.line, found.column, str(found.values["text"])) for found in listing.findings]


def every_line_odd(codes: Codes) -> PlainWords:
    """What `plain_words` gives of a text in which no line is plain."""
    text = codes.tobytes().decode("ascii")
    spans, at = [], 0
    for line in text.replace("\r", "\n").split("\n"):
        inked = [place for place, char in enumerate(line) if char > " "]
        if inked:
            spans.append((at + inked[0], at + inked[-1] + 1))
        at += len(line) + 1
    return NO_WORDS._replace(odd=np.array(spans, dtype=np.int64).reshape(-1, 2))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("G91G92 X115000 Y-10000", [("G", 91, -1), ("G", 92, -1), ("X", 115000, -1), ("Y", -10000, -1)]),
        ("G92X0Y0", [("G", 92, -1), ("X", 0, -1), ("Y", 0, -1)]),
        ("N0010 X+200 Y10. I.013 J-.5", [("N", 10, -1), ("X", 200, -1), ("Y", 10, 0), ("I", 0.013, 3), ("J", -0.5, 1)]),
        ("G 01 X - 5\tY + .25", [("G", 1, -1), ("X", -5, -1), ("Y", 0.25, 2)]),
        ("g01 x10", [("G", 1, -1), ("X", 10, -1)]),
        ("M78 M78", [("M", 78, -1), ("M", 78, -1)]),
        ("Ｇ０１　Ｘ１．５", [("G", 1, -1), ("X", 1.5, 1)]),
        ("X0.1 Y123456.789012", [("X", 0.1, 1), ("Y", 123456.789012, 6)]),
        ("X12345678901234567890. Y1", [("X", 1e15, 0), ("Y", 1, -1)]),
        ("G90.1", [("G", 90.1, 1)]),
        ("N06 G90 G41 D11 G01 X200 Y300 F200 ;", [("N", 6, -1), ("G", 90, -1), ("G", 41, -1), ("D", 11, -1)]),
    ],
)
def test_a_block_is_its_words(text: str, words: list[tuple[str, float, int]]) -> None:
    listing = read_listing(text)
    assert words_of(listing)[0][: len(words)] == words
    assert not listing.blocks.is_damaged.any()


def test_words_have_their_places_and_blocks_their_lines() -> None:
    listing = read_listing("%\r\n\r\n  N10 G01 X 1.5 ;\r\n(a) Y2 (b)\r\nM02\r\n%")
    assert [listing.written(word) for word in range(len(listing.words.letter))] == ["N10", "G01", "X 1.5", "Y2", "M02"]
    assert listing.blocks.line.tolist() == [3, 4, 5]
    spans = zip(listing.blocks.first, listing.blocks.past, strict=True)
    assert [listing.text[first:past] for first, past in spans] == ["N10 G01 X 1.5", "Y2", "M02"]
    assert [listing.text[first:past] for first, past in listing.remarks] == ["(a)", "(b)"]
    assert listing.words.block.tolist() == [0, 0, 0, 1, 2]


@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
def test_line_ends_change_nothing(newline: str) -> None:
    text = "G92 X0 Y0\nG01 X1\n\n  \nM02\n".replace("\n", newline)
    assert words_of(read_listing(text)) == [
        [("G", 92, -1), ("X", 0, -1), ("Y", 0, -1)],
        [("G", 1, -1), ("X", 1, -1)],
        [("M", 2, -1)],
    ]


def test_the_tape_begins_and_ends_with_a_sign() -> None:
    listing = read_listing("leader\n%\n% (MEM:F17A15.ISO) G99\nO0027\nG01 X1\nM02 %\nwhat ?!\nG01 X9\n")
    assert words_of(listing) == [[("O", 27, -1)], [("G", 1, -1), ("X", 1, -1)], [("M", 2, -1)]]
    assert listing.text[listing.tape_end] == "%"
    assert told(listing) == [("ISO107", 1, 1, "leader")]


def test_a_text_without_an_end_sign_goes_to_its_end() -> None:
    for text in ("G01 X1\n", "%\nG01 X1\n"):
        assert read_listing(text).tape_end == len(text)


def test_skipped_blocks_are_told_apart() -> None:
    listing = read_listing("/N10 G01 X1\n/2 X2\nX3\n")
    assert listing.blocks.is_skipped.tolist() == [True, True, False]
    assert words_of(listing)[1] == [("X", 2, -1)]
    assert not listing.findings


@pytest.mark.parametrize(
    ("text", "registers"),
    [
        ("H001=110", [("H1", ((110.0, -1),))]),
        ("H001 = +000000.1690 ;", [("H1", ((0.169, 4),))]),
        ("H1 =.0085 + H175", [("H1", ((0.0085, 4), "H175"))]),
        ("H1 = H175 - .002", [("H1", ("H175", (-0.002, 3)))]),
        ("N5 D01=100 H000 = -.01", [("D1", ((100.0, -1),)), ("H0", ((-0.01, 2),))]),
    ],
)
def test_offset_registers_are_set(text: str, registers: list[tuple[str, tuple[object, ...]]]) -> None:
    listing = read_listing(f"G90\n{text}\n")
    assert [(one.register, one.terms) for one in listing.assignments] == registers
    assert {one.block for one in listing.assignments} == {1}
    assert listing.text[slice(*listing.assignments[0].span)].startswith(("H", "D"))
    assert not listing.findings


@pytest.mark.parametrize(
    ("text", "form"),
    [
        ("E001=   004 005 006", Form.SETTING),
        ("C000   = 012 014 +5 x", Form.SETTING),
        ("QAIC(2,1,0.1250,3);", Form.FUNCTION),
        ("#100 = #101 + 1", Form.MACRO),
        ("IF [#1 GT 0] GOTO 10", Form.MACRO),
        ("G01 X#100 Y5", Form.MACRO),
        ("G01 X#100 Y5 F200", Form.MACRO),
        ("GOTO 20", Form.MACRO),
        ("G01 X5 Y0 : G01 X6 Y1 ;", Form.TWO_PLANES),
    ],
)
def test_other_forms_are_told_apart(text: str, form: Form) -> None:
    listing = read_listing(f"G90\n{text}\n")
    assert [(one.form, one.block) for one in listing.statements] == [(form, 1)]
    assert listing.blocks.is_damaged.tolist() == [False, form is Form.MACRO]
    assert not listing.findings


def test_a_feed_in_a_variable_leaves_its_block_what_it_is() -> None:
    listing = read_listing("N4 G03 X50. Y0 J-50. F#61 ;\nF #7\n")
    assert words_of(listing) == [[("N", 4, -1), ("G", 3, -1), ("X", 50, 0), ("Y", 0, -1), ("J", -50, 0)], []]
    assert [(one.form, one.block) for one in listing.statements] == [(Form.FEED, 0), (Form.FEED, 1)]
    assert [listing.text[slice(*one.span)] for one in listing.statements] == ["F#61", "F #7"]
    assert not listing.blocks.is_damaged.any()
    assert not listing.findings


@pytest.mark.parametrize("text", ["G01 X5 F#", "G01 X5 F#6.1", "G01 X5 F#6A1", "G01 X5 F-#61"])
def test_other_signs_behind_a_feed_are_no_variable(text: str) -> None:
    assert read_listing(f"{text}\n").blocks.is_damaged.tolist() == [True]


def test_of_two_planes_the_words_are_those_of_the_lower_one() -> None:
    listing = read_listing("N5 G01 X5 Y0 : G01 X6 Y1 ;")
    assert words_of(listing) == [[("N", 5, -1), ("G", 1, -1), ("X", 6, -1), ("Y", 1, -1)]]


@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("G01 X10 ,5", [("ISO101", 9, ",5")]),
        ("G01 X1..2 Y3", [("ISO102", 5, "X1..2")]),
        ("G01 Y X-", [("ISO102", 5, "Y"), ("ISO102", 7, "X-")]),
        ("G01 X1 0", [("ISO102", 5, "X1 0")]),
        ("G01 X1-2", [("ISO102", 5, "X1-2")]),
        ("G01 X.", [("ISO102", 5, "X.")]),
        ("12 G01", [("ISO101", 1, "12")]),
        ("GO1 X5", [("ISO102", 1, "G")]),
        ("THIS IS NO BLOCK", [("ISO101", 1, "THIS IS NO BLOCK")]),
        ("X1 (open", [("ISO105", 4, "(open")]),
        ("X1 (one (two) three) Y2", [("ISO105", 4, "(one (two) three) Y2")]),
        ("X1 )", [("ISO101", 4, ")")]),
        ("H001=", [("ISO102", 1, "H001=")]),
        ("H001=110 X", [("ISO102", 10, "X")]),
    ],
)
def test_what_is_no_word_is_told_with_its_place(line: str, found: list[tuple[str, int, str]]) -> None:
    listing = read_listing(f"G01 X0\n{line}\nM02\n")
    assert told(listing) == [(code, 2, column, text) for code, column, text in found]
    assert listing.blocks.is_damaged.tolist() == [False, True, False]
    assert {one.block for one in listing.unread} == {1}


def test_an_open_remark_alone_stands_in_no_block() -> None:
    listing = read_listing("G01 X0\n(open\nM02\n")
    assert [one.block for one in listing.unread] == [-1]
    assert not listing.blocks.is_damaged.any()


@pytest.mark.parametrize(
    ("remark", "is_hidden"),
    [
        ("; G01 X10", True),
        (";X1Y2", True),
        ("(G01 X10)", True),
        ("; Number : 1", False),
        ("(D0.25 S1)", False),
        ("(G01)", False),
        ("; X marks the spot", False),
        ("(1. CUT)", False),
    ],
)
def test_a_block_in_a_remark_is_noted(remark: str, is_hidden: bool) -> None:
    listing = read_listing(f"G01 X0 {remark}\nM02 {remark}\n")
    assert [(found.code, found.values["more"]) for found in listing.findings] == [("ISO106", 1)] * is_hidden


def test_titles_are_noted_in_the_head_alone() -> None:
    listing = read_listing(" SQUARE PROGRAM \nO1\n零件 1\nG90\nSQUARE\n")
    assert [(found.code, found.line, found.values.get("more")) for found in listing.findings] == [
        ("ISO107", 1, 1),
        ("ISO101", 5, None),
    ]


def test_small_letters_are_told_once_and_mended_everywhere() -> None:
    text = "G92 X0 (start) y0\ng01 x1 (small remark)\n/m02\n"
    (found,) = read_listing(text).findings
    assert (found.code, found.line, found.column, found.values["more"]) == ("ISO104", 1, 16, 3)
    assert edited(text, found.edits) == "G92 X0 (start) Y0\nG01 X1 (small remark)\n/M02\n"


def text_of(rng: random.Random) -> str:
    return "".join(rng.choice(PIECES) for _ in range(rng.randrange(3, 60)))


def test_plain_lines_are_read_as_all_others_are(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = random.Random(19)
    plain = 0
    for _ in range(400):
        text = text_of(rng)
        by_arrays = read_listing(text)
        with monkeypatch.context() as patched:
            patched.setattr(lexer, "plain_words", every_line_odd)
            one_by_one = read_listing(text)
        for name in ("words", "blocks"):
            columns = zip(getattr(by_arrays, name), getattr(one_by_one, name), strict=True)
            assert all(np.array_equal(one, other) for one, other in columns), (name, text)
        for name in ("assignments", "statements", "unread", "tape_end", "findings"):
            assert getattr(by_arrays, name) == getattr(one_by_one, name), text
        plain += len(by_arrays.blocks.line)
    assert plain > 500


def plain_remarks(text: str) -> list[tuple[int, int]]:
    """Remarks of a text by a loop over its characters; without the signs that close blocks, and functions."""
    found, at = [], 0
    while at < len(text):
        line = text[at:].split("\n", maxsplit=1)[0]
        if text[at] == ";" and line.strip(" \t") != ";":
            found.append((at, at + len(line)))
            at += len(line)
        elif text[at] == "(":
            close, again = line.find(")"), line.find("(", 1)
            is_whole = close > 0 and not 0 < again < close
            past = at + (close + 1 if is_whole else len(line))
            found.append((at, past))
            at = past
        else:
            at += 1
    return found


def test_remarks_are_those_of_a_plain_loop() -> None:
    rng = random.Random(4)
    for _ in range(300):
        text = "".join(rng.choice(["(", ")", ";", " ", "\n", "X1", "a", ",", "9"]) for _ in range(rng.randrange(40)))
        if "aa(" in text.replace("X1", "1") or "aX1" in text:
            continue
        assert [tuple(span) for span in read_listing(text).remarks.tolist()] == plain_remarks(text), text


@pytest.mark.parametrize("text", ["", "\n", "(remark)", "%", ";", "\0", "%\n%\n"])
def test_a_text_may_hold_no_block(text: str) -> None:
    listing = read_listing(text)
    assert len(listing.blocks.line) == len(listing.words.letter) == 0
    assert listing.blocks.word.tolist() == [0]
