"""Tables of what a run came to: blocks, contours, deviations, limits and losses of the drives, checks."""

from typing import Any, Final, cast

from parser.findings.catalogue import LANGUAGES, Bilingual
from parser.shape.contours import Contour
from parser.text.source import BlockNames
from sim.run.dryrun import DryRun
from sim.run.report.model import ReportDocument
from sim.run.report.run_model import CauseEntry, PassEntry, SparkMomentEntry
from sim.run.report.taper import TaperEntry
from sim.setup.key_words import value_word
from sim.show.report_page.findings import address
from sim.show.report_page.tables import (
    Column,
    ReportTable,
    called,
    column_of,
    counted,
    micrometres,
    millimetres,
    named,
    reached,
    timed,
    worded,
    yes_or_no,
)
from sim.show.spark_rows import event_words
from sim.show.texts import bilingual
from sim.show.texts.phrases import catalogued

CodeLink = tuple[str, str]
"""A code, and the address in the page of the finding that bears it."""

_STAGES = ("interpolation", "steps", "table", "wire")


def block_table(run: DryRun, report: ReportDocument) -> ReportTable:
    """Every block of the run, as ``blocks[]`` of the report has it."""
    blocks = report["blocks"]

    def of(path: str) -> list[Any]:
        return column_of(blocks, path)

    return ReportTable(
        "blocks",
        (
            called("block", of("block"), run.block_names.at),
            counted("line", of("line")),
            Column(bilingual("report.text"), of("text"), "code"),
            worded("kind", of("kind"), "kind"),
            *_counted_by(of("count_um"), of("count_axis")),
            millimetres("from-x", of("exact.start_um.0")),
            millimetres("from-y", of("exact.start_um.1")),
            millimetres("to-x", of("exact.end_um.0")),
            millimetres("to-y", of("exact.end_um.1")),
            millimetres("radius", of("exact.radius_um")),
            millimetres("length", of("exact.length_um")),
            counted("steps", of("stepped.steps")),
            timed("seconds", report["time_s"]["by_block"]),
            micrometres("step-deviation", of("stepped.max_deviation_um")),
            micrometres("table-off", of("table.max_deviation_um")),
            Column(bilingual("report.codes"), _codes(run), "codes"),
        ),
    )


def _counted_by(count_um: list[Any], axis: list[Any]) -> tuple[Column, ...]:
    """J and G of each block; none for a program without words, which has nothing to show there."""
    if not any(axis):
        return ()
    words = [axi and f"G{axi}" for axi in axis]
    return counted("count-length", count_um), Column(bilingual("report.count-axis"), words, "code")


def _codes(run: DryRun) -> list[list[CodeLink]]:
    """Codes of the findings on each block; findings name blocks of the program, which an offset may have several of."""
    by_block: dict[int, list[CodeLink]] = {}
    for at, finding in enumerate(run.findings):
        by_block.setdefault(finding.block, []).append((finding.code, address(at)))
    return [by_block.get(block, []) for block in run.toolpath.source.block.tolist()]


def contour_table(run: DryRun, report: ReportDocument) -> ReportTable:
    """Contours with their closures and times."""
    entries = report["contours"]
    return ReportTable(
        "contours",
        (
            counted("number", list(range(1, len(entries) + 1))),
            called("first-block", column_of(entries, "first_block"), run.block_names.at),
            called("last-block", column_of(entries, "last_block"), run.block_names.at),
            worded("state", [_state(contour) for contour in run.whole_contours]),
            micrometres("exact-closure", column_of(entries, "closure_exact_um")),
            micrometres("stepped-closure", column_of(entries, "closure_stepped_um")),
            timed("seconds", column_of(entries, "time_s")),
        ),
    )


def pass_table(run: DryRun, report: ReportDocument) -> ReportTable:
    """Passes over each edge, as ``passes[]`` of the report has them."""
    entries = report["passes"]
    return ReportTable(
        "passes",
        (
            counted("contour", column_of(entries, "contour")),
            counted("pass-number", column_of(entries, "number")),
            worded("pass-kind", [_pass_kind(entry) for entry in entries]),
            worded("pass-way", column_of(entries, "direction")),
            called("first-block", column_of(entries, "blocks.0"), run.block_names.at),
            called("last-block", column_of(entries, "blocks.1"), run.block_names.at),
            micrometres("pass-offset", column_of(entries, "offset_um"), digits=1),
            millimetres("length", column_of(entries, "length_um")),
            timed("seconds", column_of(entries, "time_s")),
            micrometres("stock-least", column_of(entries, "stock_um.least"), digits=1),
            micrometres("stock-most", column_of(entries, "stock_um.most"), digits=1),
            micrometres("stock-mean", column_of(entries, "stock_um.mean"), digits=1),
            micrometres("wire-off", column_of(entries, "deviation.max_um")),
        ),
    )


_UNITS: Final = {"gap_um": "µm", "feed_mm_min": "mm/min", "lag_um": "µm", "offset_um": "µm", "roughness_um": "µm"}


def technology_table(report: ReportDocument) -> ReportTable:
    """What the technology says, or what is assumed: a row for each figure of each pass."""
    rows = [
        (of_pass["number"], name, figure)
        for of_pass in report["technology"]["passes"]
        for name, figure in ((name, reached(of_pass, name)) for name in _UNITS)
        if figure is not None
    ]
    figures = [figure for _, _, figure in rows]
    grades = column_of(figures, "grade")
    words = {grade: value_word(grade) for grade in dict.fromkeys(grades)}
    return ReportTable(
        "technology",
        (
            counted("pass-number", [number for number, _, _ in rows]),
            worded("figure", [name for _, name, _ in rows], "of"),
            *(
                Column(bilingual(f"report.{head}"), column_of(figures, key), digits=2)
                for head, key in (("middle", "value"), ("at-least", "least"), ("at-most", "most"))
            ),
            named("unit", [_UNITS[name] for _, name, _ in rows]),
            Column(bilingual("report.grade"), grades, "word", words=words),
            named("source", column_of(figures, "source")),
        ),
    )


def _pass_kind(entry: PassEntry) -> str:
    if entry["cuts_tab"]:
        return "tab"
    return "trim" if entry["number"] > 1 else "rough"


def _state(contour: Contour) -> str:
    if not contour.encloses:
        return "parting"
    return "open" if contour.is_open else "closed"


def deviation_table(run: DryRun, report: ReportDocument) -> ReportTable:
    """Deviation of steps, table and wire."""
    deviation = report["deviation"]
    entries = [deviation["interpolation"], deviation["steps"], deviation["table"], deviation["wire"]]
    return ReportTable(
        "deviation",
        (
            worded("of", _STAGES, "of"),
            micrometres("largest", column_of(entries, "max_um")),
            micrometres("rms", column_of(entries, "rms_um")),
            micrometres("p95", column_of(entries, "p95_um")),
            *_met(run.block_names, entries, "where."),
        ),
    )


def cause_table(run: DryRun, report: ReportDocument) -> ReportTable:
    """What each cause adds to the deviation."""
    causes = report["deviation"]["by_cause"]
    entries = cast("list[CauseEntry]", list(causes.values()))
    largest = micrometres("largest", column_of(entries, "max_um"))
    met = _met(run.block_names, entries, "where.")
    return ReportTable("causes", (worded("cause", tuple(causes), "by"), largest, *met))


def limit_table(run: DryRun, report: ReportDocument) -> ReportTable:
    """How near the drives came to their limits."""
    entries = report["limits"]
    return ReportTable(
        "limits",
        (
            worded("quantity", column_of(entries, "quantity")),
            named("axis", column_of(entries, "axis")),
            Column(bilingual("report.value"), column_of(entries, "value"), digits=2),
            Column(bilingual("report.limit"), column_of(entries, "limit"), digits=2),
            named("unit", [{"force": "N", "speed": "µm/s", "lag": "µm"}[entry["quantity"]] for entry in entries]),
            Column(bilingual("report.share"), column_of(entries, "share"), unit="%", per=0.01, digits=1),
            *_met(run.block_names, entries),
        ),
    )


def loss_table(run: DryRun, report: ReportDocument) -> ReportTable:
    """What the drives lost."""
    entries = report["losses"]
    what = worded("what", column_of(entries, "kind"))
    amount = micrometres("amount", column_of(entries, "amount_um"))
    axis, met = named("axis", column_of(entries, "axis")), _met(run.block_names, entries)
    return ReportTable("losses", (what, axis, amount, *met))


def spark_tables(run: DryRun, report: ReportDocument) -> list[ReportTable]:
    """The cut under sparks: its figures, what happened, and the marks that it left; none without one."""
    spark, names = report["spark"], run.block_names
    if spark is None:
        return []
    figures = [spark]
    happened = spark["events"] if spark["stopped"] is None else [*spark["events"], spark["stopped"]]
    return [
        ReportTable(
            "sparks",
            (
                micrometres("front-gap", column_of(figures, "gap_um"), 1),
                Column(bilingual("report.voltage"), column_of(figures, "mean_voltage_share"), "number", "%", 0.01, 1),
                Column(
                    bilingual("report.area-rate"), column_of(figures, "area_rate_mm2_min"), unit="mm²/min", digits=1
                ),
                Column(bilingual("report.feed"), column_of(figures, "feed_um_s"), "number", "mm/min", 1000.0 / 60.0, 3),
                timed("spark-time", column_of(figures, "time_s")),
                timed("lost-time", column_of(figures, "lost_s")),
                counted("shorts", column_of(figures, "shorts")),
                millimetres("gone-back", column_of(figures, "retreated_um")),
                counted("breaks", column_of(figures, "breaks")),
            ),
        ),
        ReportTable("events", (_events(happened), *_met(names, happened), *_counters(happened))),
        ReportTable(
            "marks",
            (
                called("block", column_of(spark["marks"], "block"), names.at),
                millimetres("at-x", column_of(spark["marks"], "x_um")),
                millimetres("at-y", column_of(spark["marks"], "y_um")),
                micrometres("depth", column_of(spark["marks"], "depth_um"), 1),
                micrometres("depth-within", column_of(spark["marks"], "within_um"), 1),
            ),
        ),
    ]


def taper_tables(report: ReportDocument) -> list[ReportTable]:
    """The cut of a wire that leans: its figures, its sections and its pieces; none of an upright one."""
    taper = report["taper"]
    return [] if taper is None else [_lean_table(taper), _section_table(taper), _solid_table(taper)]


def _lean_table(taper: TaperEntry) -> ReportTable:
    """One row: how the wire leans, and what that comes to."""
    volume = taper["volume_mm3"]
    return ReportTable(
        "taper",
        (
            _number("taper-angle", [taper["angle_deg"]], "°", 3),
            _number("lean-most", [taper["lean_most_deg"]], "°", 3),
            millimetres("uv-walls", [taper["uv_most_um"]["side"]]),
            millimetres("uv-most", [taper["uv_most_um"]["corner"]]),
            _number("four-axes-time", [taper["time_s"]], "s", 2),
            _number("volume-programmed", [volume["programmed"]], "mm³", 2),
            _number("volume-pieces", [volume["piece"]], "mm³", 2),
            yes_or_no("guides-assumed", [taper["guides_assumed"]]),
        ),
    )


def _section_table(taper: TaperEntry) -> ReportTable:
    """The cut at each height."""
    sections = taper["sections"]
    return ReportTable(
        "sections",
        (
            _number("section-height", column_of(sections, "z_mm"), "mm", 3),
            _number("section-width", column_of(sections, "box_mm.0"), "mm", 3),
            _number("section-depth", column_of(sections, "box_mm.1"), "mm", 3),
            _number("area-programmed", column_of(sections, "programmed_area_mm2"), "mm²", 2),
            _number("area-pieces", column_of(sections, "piece_area_mm2"), "mm²", 2),
            micrometres("off-wall", column_of(sections, "max_deviation_um")),
        ),
    )


def _solid_table(taper: TaperEntry) -> ReportTable:
    """Pieces through the whole work."""
    pieces = taper["pieces"]
    return ReportTable(
        "solids",
        (
            worded("solid", column_of(pieces, "kind")),
            _number("volume", column_of(pieces, "volume_mm3"), "mm³", 2),
            _number("mass", column_of(pieces, "mass_g"), "g", 1),
            worded("larger", column_of(pieces, "larger")),
            yes_or_no("falls", column_of(pieces, "drops")),
        ),
    )


def _number(head: str, values: list[Any], unit: str, digits: int) -> Column:
    """Numbers that are shown as they are, in a unit."""
    return Column(bilingual(f"report.{head}"), values, "number", unit, 1.0, digits)


def _events(happened: list[SparkMomentEntry]) -> Column:
    """What happened: kinds of events by the words of settings."""
    kinds = [each["kind"] for each in happened]
    return Column(bilingual("report.event"), kinds, "word", words={kind: event_words(kind) for kind in kinds})


def _counters(happened: list[SparkMomentEntry]) -> tuple[Column, ...]:
    """What the control had in its counters, for who has to type it in again."""
    return (
        counted("count-length-left", column_of(happened, "count_left_um")),
        counted("deviation-f", column_of(happened, "deviation")),
    )


def check_table(run: DryRun) -> ReportTable:
    """How far each check came."""
    checks = run.coverage.checks
    reasons = {check.reason: Bilingual(*map(check.because, LANGUAGES)) for check in checks}
    return ReportTable(
        "checks",
        (
            _terms("check", [check.name for check in checks]),
            worded("state", [check.state.replace(" ", "-") for check in checks]),
            Column(bilingual("report.reason"), [check.reason for check in checks], "word", words=reasons),
        ),
    )


def _terms(head: str, keys: list[str]) -> Column:
    """Terms of the catalogue; nothing for an empty key."""
    return Column(
        bilingual(f"report.{head}"), keys, "word", words={key: catalogued(key) for key in dict.fromkeys(keys)}
    )


def _met(names: BlockNames, entries: list[Any], where: str = "") -> tuple[Column, ...]:
    """Block, place and time of what was met."""
    return (
        called("block", column_of(entries, f"{where}block"), names.at),
        millimetres("at-x", column_of(entries, f"{where}x_um")),
        millimetres("at-y", column_of(entries, f"{where}y_um")),
        timed("at-time", column_of(entries, f"{where}t_s")),
    )
