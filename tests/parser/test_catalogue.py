"""The catalogue: every code has its page in both languages, and its templates fill from the values it is given."""

import re
import string
import tomllib
from importlib import resources
from typing import get_args

import pytest

from parser.findings.catalogue import (
    LANGUAGES,
    CataloguePage,
    Language,
    Remark,
    Texts,
    example,
    instant,
    page,
    remark_text,
    texts,
)
from parser.findings.codes import CODES, Severity
from parser.findings.findings import Finding, Value, counted
from parser.text.encoding import no_program

PAGES = resources.files("parser.findings") / "pages"
TEMPLATES = ("found", "expected", "machine", "hint")
LINE = 110
NO_EXAMPLE = {"3B100", "3B303", "ISO100"} | {code for code, of in CODES.items() if of.check is None}

VALUES: dict[str, dict[str, Value]] = {
    "3B100": {"what": "unreadable-file", "detail": "Permission denied", "hint": "hint-program"},
    "3B101": {"text": "second {cut}"},
    "3B102": {},
    "3B103": {"blocks": 4, "mark": "DD"},
    "3B104": {},
    "3B105": {"mark": "E"},
    "3B106": {"field": "field-axis", "found": "nothing", "wanted": "wanted-axis"},
    "3B107": {"label": "N2", "line": 2},
    "3B108": {"header": 65437.0, "decoded": 82003.53},
    "3B109": {"three": 3, "four": 1},
    "3B110": {"blocks": 3, "path": "path-without-offset"},
    "3B111": {"header": 0.0, "reach": 100.0},
    "3B112": {"header": 70.0, "reach": 100.0},
    "3B113": {"what": "directive-unknown-code", "text": "3B2O4"},
    "3B114": {"silenced": "3B204"},
    "3B201": {"x": 0, "y": 0},
    "3B202": {"axis": "Y", "other": "X"},
    "3B203": {"written": "L1", "ruled": "L2", "way": "+Y", "others": ""},
    "3B204": {"axis": "X", "ruled": "Y", "cost": 140.0, "right": 0.0, "count": 39600},
    "3B205": {},
    "3B206": {"what": "number-too-large", "limit": 999_999_999},
    "3B207": {"px": 9900.0, "py": -0.0, "x": 9800.0, "y": 0.0, "off": 100.0, "advice": "restore-block"},
    "3B208": {"count": 9990, "extent": 9900, "axis": "X", "off": 90.0, "goes": "too-far", "by": 90.0},
    "3B209": {"count": 19800, "extent": 9900, "axis": "X", "times": 2},
    "3B210": {"count": 79200, "full": 39600, "turns": 2.0},
    "3B211": {"written": "SR", "other": "NR", "sweep": 270, "minor": 90},
    "3B212": {"radius": 9990, "decoded": 9900.0},
    "3B213": {"px": 9900.0, "py": 0.0, "x": 9897.0, "y": 0.0, "off": 3.0},
    "3B214": {"other": 2, "angle": 90.0, "offset": 100.0, "shift": 141.42, "more": 3},
    "3B215": {"written": "DD", "ruled": "D", "more": 0},
    "3B216": {"radius": 80.0, "offset": 100.0},
    "3B217": {"field": "field-sense", "written": "L3", "other": "L1", "px": 9900.0, "py": 0.0, "off": 19800.0},
    "3B301": {"first": 1, "last": 4, "gap": 6929.65},
    "3B302": {"first": 1, "last": 12, "gap": 35.2, "limit": 26.7},
    "3B303": {"miss": 12.5, "limit": 12.0},
    "3B304": {"first": 1, "last": 6, "field": "field-sense", "written": "L4", "other": "L2", "others": ""},
    "3B305": {"radius": 50.0, "offset": 100.0},
    "3B306": {"written": "SR", "other": "NR", "word": "NR2"},
    "3B307": {"crossing": 7, "other": 4, "x": -2000.0, "y": 2000.0, "more": 0},
    "3B308": {},
    "3B309": {"length": 30000.0},
    "3B310": {"length": 30000.0, "jump": "D … D"},
    "3B311": {"first": 1, "last": 7, "gap": 1414.2},
    "3B312": {"number": 3, "other": 2, "by": 20.0},
    "3B313": {"number": 2, "other": 1, "by": 250.0, "left": 50.0, "kerf": 200.0},
    "3B314": {"number": 1, "by": 30.0},
    "3B315": {"first": 2, "last": 12, "gap": 600.0, "pause": "D"},
    "3B316": {"number": 2, "other": 1, "by": 190.0},
    "3B317": {"by": 7046.0, "first": 1, "last": 5},
    "3B318": {"other": 3},
    "3B319": {"other": 1},
    "3B322": {"field": "field-sense", "written": "NR2", "other": "NR4", "others": "", "first": 1, "last": 27},
    "3B321": {"by": 139.57, "x_mm": -0.601, "y_mm": 1.83},
    "3B320": {"lines": 4, "last": 9, "length": 40000.0},
    "3B401": {"x_mm": 400.0, "y_mm": 500.0, "axis": "X", "by": 10000.0},
    "3B402": {
        "axis": "X",
        "lost": 18.0,
        "last": 12,
        "chance": "12‥24 µm",
        "t_s": 11524.25,
        "x_mm": 12.5,
        "y_mm": -0.0001,
    },
    "3B403": {"axis": "Y", "lag": 100.2, "limit": 100.0, "t_s": 3.0, "x_mm": 12.5, "y_mm": 0.0},
    "3B404": {"body": "arm", "name": "left clamp", "t_s": 3.0, "x_mm": 12.5, "y_mm": 0.0},
    "3B405": {"t_s": 3.0, "x_mm": 12.5, "y_mm": 0.0},
    "3B406": {"kind": "slug", "area_mm2": 12.5, "cut_after": 5e3, "t_s": 3.0, "x_mm": 12.5, "y_mm": 0.0, "pause": "D"},
    "3B407": {"first": 3, "last": 17},
    "3B408": {"t_s": 3.0, "x_mm": 12.5, "y_mm": 0.0},
    "3B490": {"path": "summary.steps", "found": "99000", "wanted": "‥5"},
    "3B501": {"radius": 50.0, "offset": 100.0, "left": 20.7, "x_mm": 12.5, "y_mm": 0.0},
    "3B502": {"offset": 100.0, "left": 3.2, "x_mm": 12.5, "y_mm": 0.0},
    "3B503": {"other": 9, "pass": 2, "depth": 110.0, "offset": 100.0, "x_mm": 12.5, "y_mm": 0.0},
    "3B504": {"loops": 2, "offset": 100.0},
    "3B505": {"first": 1, "last": 7, "before": 1, "number": 2, "gap": 1414.2},
    "3B506": {"header": 100.0, "added": 100.0},
    "3B601": {"what": "edge-off", "off": 7.0, "tolerance": 5.0, "x_mm": 12.5, "y_mm": 0.0, "entity": "ARC 2F"},
    "3B602": {"what": "wrong-side"},
    "3B603": {"number": 4, "depth": 41.4, "reach": 100.0, "angle_deg": 90.0, "x_mm": 12.5, "y_mm": 0.0},
    "3B604": {"what": "contour-offset-missing", "first": 7, "last": 9, "inside_mm": 0.1},
    "3B605": {"first": 7, "last": 9, "shift_x_mm": 0.05, "shift_y_mm": 0.0, "tolerance": 5.0},
    "3B606": {"off": 4.0, "within": 2.0, "most": 6.0, "tolerance": 5.0, "x_mm": 12.5, "y_mm": 0.0},
    "3B607": {"number": 3, "offset": 100.0, "reach": 97.0, "least": 96.0, "most": 98.0, "by": 3.0},
    "3B608": {"number": 2, "taken": 0.0},
    "3B609": {"time_s": 3.2, "why": "stop-in-vain"},
    "3B701": {"what": "turned-arc", "size": 2000.0, "z_mm": 38.16, "off_mm": 38.16, "more": 1},
    "3B702": {"axis": "U", "most_mm": 14.823, "travel_mm": 12.0},
    "3B703": {"angle_deg": 4.239, "most_deg": 4.0},
    "3B704": {"by_mm": 1.5, "wide_mm": 320.0, "deep_mm": 250.0},
    "3B705": {"what": "pair-counts", "lower": 8, "upper": 7, "name": "upper.3b"},
    "3B706": {"lower_mm": 10.0, "upper_mm": 0.1, "more": 0},
    "3B708": {"offset_mm": 0.1, "off": 15.5, "needed_mm": 0.1155},
    "3B709": {"z_mm": 40.0},
    "3B710": {},
    "3B711": {"what": "edge-off", "off": 7.0, "tolerance": 5.0, "x_mm": 12.5, "y_mm": 0.0, "entity": "ARC 2F"},
    "3B712": {"other": "3B503", "more": 1},
    "GEC401": {"call": "GT_ZeroPos(1)", "answer": 1, "function": "GT_ZeroPos", "then": "GT_LnXY(30000.0, 0.0)"},
    "GEC402": {"axis": 1, "side": "limit-negative", "t_s": 16.45},
    "GEC403": {"slept_s": 2.0, "needed_s": 3.4642, "short_s": 1.4642, "call": "GT_ZeroPos(1)", "more": 2},
    "ISO100": {"what": "mill-tool", "detail": "M06", "hint": "hint-wire-program"},
    "ISO101": {"text": ",5"},
    "ISO102": {"text": "X1..2"},
    "ISO103": {"text": "W3", "letter": "W"},
    "ISO104": {"text": "g01", "more": 7},
    "ISO105": {"text": "(open"},
    "ISO106": {"text": "; G01 X10", "more": 0},
    "ISO107": {"text": "SQUARE PROGRAM", "more": 0},
    "ISO108": {"text": "G01 X0 Y9000"},
    "ISO109": {"text": "G01 X0 Y5000"},
    "ISO110": {"text": "N30", "what": "nothing-but-n"},
    "ISO111": {"word": "X10.", "integer": "0.001 mm", "point": "1 mm", "integers": 12, "points": 1},
    "ISO113": {"text": "G92"},
    "ISO112": {
        **{"dialect": "fast-wire", "integer": "0.001 mm", "point": "1 mm"},
        **{"distance": "G91", "centers": "centres-from-start"},
    },
    "ISO120": {"number": "N15", "before": "N20"},
    "ISO121": {"label": "N1", "what": "label-twice", "lines": "3, 9"},
    "ISO130": {"word": "G01", "before": "D11", "more": 0},
    "ISO200": {"word": "G02", "other": "G01", "group": "group-motion"},
    "ISO201": {"word": "X2", "other": "X1"},
    "ISO202": {"word": "R5"},
    "ISO203": {"word": "G123"},
    "ISO204": {"word": "G26", "more": 0},
    "ISO205": {"word": "D1.2", "letter": "D"},
    "ISO206": {"word": "F-5", "limits": "0 … 100000"},
    "ISO207": {"text": "Y5.0005", "um": 5000.5, "step": 1.0, "more": 3},
    "ISO208": {"text": "M02"},
    "ISO209": {"word": "M78"},
    "ISO210": {"what": "arc-no-center"},
    "ISO211": {},
    "ISO212": {"start": 5020.0, "end": 4980.0, "off": 40.0, "limit": 2.828},
    "ISO213": {"chord": 10000.0, "reach": 8000.0},
    "ISO214": {"radius": 5000.0},
    "ISO215": {"arcs": 90, "taken": "centres-from-start", "fits": "centres-absolute"},
    "ISO216": {"size": 100.0, "fits": 100000.0, "unit": "unit-mm", "name": "mm"},
    "ISO217": {"what": "tiny-for-circle", "chord": 1.0, "full": 31415.93},
    "ISO218": {},
    "ISO303": {"text": "G92 X0 Y0", "x": 0.0, "y": 5000.0},
    "ISO400": {"text": "M98 P2", "what": "call-without-label"},
    "ISO401": {"text": "N2"},
    "ISO402": {"text": "#100 = 5", "more": 0},
    "ISO500": {"side": "G41", "register": "H1", "lacking": "H175"},
    "ISO501": {"side": "G41", "register": ""},
    "ISO502": {"what": "set-up", "side": "G41", "register": "D0", "offset": 100.0},
    "ISO503": {"length": 50.0, "offset": 100.0},
    "ISO504": {
        **{"radius": 50.0, "offset": 100.0, "left": 20.7, "x_mm": 12.5, "y_mm": 0.0},
        **{"act": "compensation-leaves-out"},
    },
    "ISO505": {"offset": 100.0, "left": 3.2, "x_mm": 12.5, "y_mm": 0.0, "act": "compensation-stops"},
    "ISO506": {"other": 9, "pass": 2, "depth": 110.0, "offset": 100.0, "x_mm": 12.5, "y_mm": 0.0},
    "ISO507": {"loops": 2, "offset": 100.0},
    "ISO508": {"before": "G41", "side": "G42", "more": 0},
    "ISO509": {"was": 10.0, "offset": 213.0, "more": 0},
    "ISO510": {"side": "G41", "offset": 100.0},
    "ISO512": {"side": "G42", "other": "G41"},
    "ISO513": {"side": "G41", "register": "D0"},
    "ISO514": {"left": 11.8, "offset": 100.0},
    "ISO511": {"text": "G92 X5000 Y5000"},
    "ISO219": {"written": "G02", "other": "G03", "word": "G03"},
    "ISO300": {"first": 1, "last": 4, "gap": 10000.0},
    "ISO301": {"length": 20000.0, "rapid": "G00"},
    "ISO302": {"more": 2, "rapid": "G00"},
    "ISO304": {"x_mm": 400.0, "y_mm": 500.0, "axis": "X", "by": 10000.0},
    "ISO305": {"crossing": 7, "other": 4, "x": -2000.0, "y": 2000.0, "more": 0},
    "ISO306": {"number": 1, "by": 49.7},
    "ISO307": {"number": 2, "other": 1, "by": 50.0},
    "ISO308": {"number": 2, "other": 1, "by": 190.0},
    "ISO309": {"left": 2000.0},
    "ISO601": {},
    "ISO600": {"word": "A1.5", "more": 3},
    "PMC100": {"what": "no-motion-program", "detail": "", "hint": "hint-program"},
    "PMC101": {"text": "WHILE"},
    "PMC102": {"word": "G41", "program": 1000, "label": "N41000", "what": "call-without-routine"},
    "PMC103": {"number": 1, "what": "buffer-not-cleared"},
    "PMC104": {"word": "X10", "other": "X1"},
    "PMC105": {"number": 2, "first": 1},
    "PMC106": {"word": "Z-1", "more": 0},
    "PMC107": {"text": "X(P1)", "why": "pmac-no-value", "what": "P1", "more": 0},
    "PMC108": {"word": "X50000", "limits": "±10 m"},
    "PMC201": {"start": 500.0, "end": 1250.0, "off": 750.0},
    "PMC202": {"what": "pmac-no-center"},
    "PMC203": {"what": "pmac-radius-short"},
    "PMC204": {"time": 12.0, "ramp": 100.0, "feed": 60.0, "runs": 7.2, "more": 0},
    "PMC205": {"off": 88.4, "ramp": 100.0, "more": 0},
    "PMC206": {"feed": 60.0},
    "PMC207": {"more": 0},
    "PMC208": {},
    "PMC209": {"word": "F-60"},
}


def written(name: str) -> dict[str, dict[str, str]]:
    return tomllib.loads((PAGES / f"{name}.toml").read_text(encoding="utf-8"))


def placeholders(template: str) -> set[tuple[str, str]]:
    return {(name, spec or "") for _, name, spec, _ in string.Formatter().parse(template) if name is not None}


def columns(line: str) -> int:
    return sum(1 if ord(letter) < 0x2E80 else 2 for letter in line)


def test_every_code_has_a_page_and_every_page_a_code() -> None:
    names = {entry.name.removesuffix(".toml") for entry in PAGES.iterdir() if entry.name.endswith(".toml")}
    assert names - {"joints", "messages", "remarks", "terms"} == set(CODES) == set(VALUES)
    assert get_args(Language) == LANGUAGES


def test_a_code_is_placed_where_its_findings_name_a_place() -> None:
    with_lengths = {code for code, values in VALUES.items() if {"x_mm", "y_mm"} <= set(values)}
    assert {code for code, of in CODES.items() if of.placed} == with_lengths - {
        "3B401",
        "ISO304",
    }  # there they are the travel


@pytest.mark.parametrize("code", sorted(CODES))
def test_a_page_has_all_keys_and_no_others(code: str) -> None:
    content = written(code)
    assert set(content) - {"example"} == set(LANGUAGES)
    for language in LANGUAGES:
        assert set(content[language]) == set(CataloguePage._fields)
        assert all(text.strip() for text in page(code, language))
    assert set(content.get("example", {})) <= {"program", "mended", "options", "files"}


@pytest.mark.parametrize("code", sorted(CODES))
def test_templates_are_one_line_without_a_stop_and_the_same_in_both_languages(code: str) -> None:
    for name in ("title", *TEMPLATES):
        english, chinese = (getattr(page(code, language), name) for language in LANGUAGES)
        for text in (english, chinese):
            assert text == text.strip()
            assert "\n" not in text
            assert text[-1] not in ".。;；"
        assert placeholders(english) == placeholders(chinese)
        assert {field for field, _ in placeholders(english)} <= set(VALUES[code])
    assert not placeholders(page(code).title)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("code", sorted(CODES))
def test_texts_fill_and_join(code: str, language: Language) -> None:
    filled = texts(Finding(code, VALUES[code]), language)
    joints = {"en": ("; expected ", "; "), "zh": ("；应为", "；")}[language]
    assert filled.message == filled.found + joints[0] + filled.expected + joints[1] + filled.machine
    assert not re.search(r"应为[!-~]", filled.message), "a Latin letter or a digit stands off from Chinese"
    for text in filled:
        assert "\n" not in text
        assert "  " not in text
    if code != "3B101":  # its text is the program's own, and may hold anything
        assert "{" not in "".join(filled)
    assert len(filled) == len(Texts._fields)


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("code", sorted(CODES))
def test_markdown_is_wrapped_and_in_its_language(code: str, language: Language) -> None:
    for text in page(code, language)[-2:]:
        assert all(columns(line) <= LINE for line in text.splitlines())
        assert any(ord(letter) >= 0x4E00 for letter in text) == (language == "zh")


@pytest.mark.parametrize("code", sorted(CODES))
def test_an_example_is_two_programs(code: str) -> None:
    shown = example(code)
    assert (shown is None) == (code in NO_EXAMPLE)
    if shown:
        assert shown.program != shown.mended
        assert all(text.endswith("\n") and not text.startswith("\n") for text in (shown.program, shown.mended))


def test_terms_have_the_same_keys_in_both_languages() -> None:
    terms = written("terms")
    assert set(terms) == set(LANGUAGES)
    assert set(terms["en"]) == set(terms["zh"])
    assert all(text and text == text.strip() for language in LANGUAGES for text in terms[language].values())


def test_lengths_terms_and_asides() -> None:
    assert texts(Finding("3B301", {"first": 1, "last": 4, "gap": 999.0})).found.startswith(
        "the contour of blocks 1 to 4 ends 999.00 µm"
    )
    values = VALUES["3B207"] | {"px": -0.2}
    assert texts(Finding("3B207", values)).found.startswith("the printed end is 0.000, 0.000 mm, 100.00 µm")
    labels = VALUES["3B203"] | {"others": "SR3 / NR2"}
    assert texts(Finding("3B203", labels)).hint.endswith(" or SR3 / NR2")
    assert texts(Finding("3B203", labels), "zh").hint.endswith("或 SR3 / NR2")
    unknown = VALUES["3B106"] | {"field": "field-y", "found": "O"}
    assert texts(Finding("3B106", unknown)).found == "Y after the second B: `O`"
    assert texts(Finding("3B106", VALUES["3B106"]), "zh").found == "计数方向 G：空缺"
    assert texts(no_program("empty")).found == "the file is empty"
    assert texts(Finding("3B100", VALUES["3B100"])).found == "the file cannot be read (Permission denied)"
    assert texts(Finding("3B402", VALUES["3B402"])).found == (
        "the X motor slips at 12.500, 0.000 mm, 3:12:04.25 into the run, and loses 18.00 µm up to block 12"
        " (12 to 24 µm in runs that begin 0.002 µm off)"
    )
    for body, english, chinese in (("wire", "the wire touches", "钼丝碰到"), ("arm", "the arm touches", "丝架碰到")):
        values = VALUES["3B404"] | {"body": body}
        assert texts(Finding("3B404", values)).found.startswith(f"{english} `left clamp`")
        assert texts(Finding("3B404", values), "zh").found.startswith(f"{chinese} `left clamp`")


@pytest.mark.parametrize(
    ("t_s", "text"),
    [
        (0.0, "0:00:00.00"),
        (9.876, "0:00:09.88"),
        (59.996, "0:01:00.00"),
        (3599.996, "1:00:00.00"),
        (360_000.5, "100:00:00.50"),
    ],
)
def test_a_time_into_a_run_is_hours_minutes_and_seconds(t_s: float, text: str) -> None:
    assert instant(t_s) == text


@pytest.mark.parametrize("code", ["3B000", "3B999", "terms", "../findings", ""])
def test_an_unknown_code_is_a_key_error(code: str) -> None:
    with pytest.raises(KeyError):
        page(code)
    with pytest.raises(KeyError):
        example(code)


def test_remarks_have_the_same_places_in_both_languages() -> None:
    remarks = written("remarks")
    assert set(remarks["en"]) == set(remarks["zh"])
    for name, text in remarks["en"].items():
        assert placeholders(text) == placeholders(remarks["zh"][name]), name


@pytest.mark.parametrize(
    ("remark", "english", "chinese"),
    [
        (Remark("mirrored"), "the program cuts the mirror image of the drawing", "程序切出的是图纸的镜像"),
        (
            Remark("unit-slip", {"times": "25.4", "larger": "unit-inch", "smaller": "unit-mm"}),
            "the program is 25.4 times the drawing's size: inches and mm are mixed up",
            "程序是图纸尺寸的 25.4 倍：单位混淆（英寸 / mm）",
        ),
        (
            Remark("lead-in-part", {"block": 7, "depth": 1234.56}),
            "the lead in block 7 cuts 1,234.6 µm into the part",
            "第 7 段的引线切入零件 1,234.6 µm",
        ),
    ],
)
def test_a_remark_is_said_in_both_languages(remark: Remark, english: str, chinese: str) -> None:
    assert (remark_text(remark), remark_text(remark, "zh")) == (english, chinese)


def test_findings_are_counted_by_their_own_severity() -> None:
    plain, graver = Finding("ISO212"), Finding("ISO212", graver=Severity.ERROR)
    told = [(count.text, count.severity) for count in counted([plain, graver, Finding("ISO112"), graver])]
    assert told == [
        *[("ISO212 ×2", Severity.ERROR), ("ISO212", Severity.WARNING)],
        ("ISO112", Severity.NOTE),
    ]
