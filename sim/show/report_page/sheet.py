"""The job sheet: what an operator takes to the machine, on one A4 page."""

from collections.abc import Iterator, Sequence
from typing import Final, NamedTuple

from parser.findings.catalogue import Bilingual
from parser.text.source import BlockNames
from parser.units import mm, mm_text
from sim.cut.pieces.pieces import Piece, Pieces
from sim.run.dryrun import DryRun
from sim.run.recording import NO_PIECES
from sim.run.report.model import ReportDocument
from sim.run.report.run_model import ThreadPointEntry
from sim.run.report.taper import TaperEntry
from sim.setup.key_words import words_of
from sim.setup.part import DEFAULT_DENSITY_G_CM3, SHEET
from sim.show.report_page.findings import ShownFinding, gravest_findings
from sim.show.report_page.tables import Column, ReportTable, called, column_of, counted, millimetres, reached, timed
from sim.show.texts import bilingual
from sim.show.texts.phrases import lasting, lasting_within, listed, machine_name, numbered, same

MOST_THREADS: Final = 12
"""Thread points that have room on the sheet."""
_MOST_FINDINGS: Final = 4


class Fact(NamedTuple):
    """What something is called, and what it is."""

    name: Bilingual
    value: Bilingual


class Thread(NamedTuple):
    """A row of the table of thread points, as people read it; lengths in mm."""

    blocks: str
    x: str
    y: str
    after: Bilingual
    reach: tuple[str, ...]
    out_x: str
    out_y: str
    out_after: Bilingual


class Sheet(NamedTuple):
    """What stands on the sheet.

    Attributes
    ----------
    facts
        Machine, work, wire, offset, passes, length, time, pieces and what they weigh.
    by_hand
        What a shop writes on the sheet, empty where it is left to be filled in.
    threads, threads_more
        The first thread points, and how many more there are.
    findings, findings_more
        The gravest findings, and how many more there are.
    """

    facts: Sequence[Fact]
    by_hand: Sequence[Fact]
    threads: Sequence[Thread]
    threads_more: int
    findings: Sequence[ShownFinding]
    findings_more: int


def sheet_of(run: DryRun, report: ReportDocument, pieces: Pieces) -> Sheet:
    """The sheet of a run; `report` is its ``report.json``, `pieces` are what its cut leaves, known without it too."""
    threads = report["thread_points"]
    gravest = gravest_findings(run, _MOST_FINDINGS)
    return Sheet(
        facts=list(_facts(run, report, pieces)),
        by_hand=[
            Fact(words_of(SHEET, key).name, same(getattr(run.scenario.sheet, key.name) or "")) for key in SHEET.keys
        ],
        threads=[_thread(entry, run.block_names) for entry in threads[:MOST_THREADS]],
        threads_more=max(len(threads) - MOST_THREADS, 0),
        findings=gravest,
        findings_more=len(run.findings) - len(gravest),
    )


def thread_table(entries: list[ThreadPointEntry], names: BlockNames) -> ReportTable:
    """All thread points, where the sheet has no room for them."""
    return ReportTable(
        "threads",
        (
            counted("number", list(range(1, len(entries) + 1))),
            called("first-block", column_of(entries, "blocks.0"), names.at),
            called("last-block", column_of(entries, "blocks.1"), names.at),
            millimetres("at-x", column_of(entries, "at_um.0")),
            millimetres("at-y", column_of(entries, "at_um.1")),
            timed("at-time", column_of(entries, "at_s")),
            *(_reach(side, entries) for side in ("left", "right", "down", "up")),
        ),
    )


def _reach(side: str, entries: list[ThreadPointEntry]) -> Column:
    head = bilingual(f"sheet.head-{side}")
    return Column(head, column_of(entries, f"{side}_um"), unit="mm", per=1000.0, digits=3)


def _facts(run: DryRun, report: ReportDocument, pieces: Pieces) -> Iterator[Fact]:
    wire, work = report["wire"], report["work"]
    sizes = {"diameter": f"{mm(wire['diameter_um']):g}", "gap": f"{wire['spark_gap_um']:g}"}
    yield Fact(bilingual("sheet.machine"), machine_name(run.scenario.machine))
    yield Fact(bilingual("sheet.work"), _work(work["thickness_mm"], work["density_g_cm3"]))
    yield Fact(bilingual("sheet.wire"), bilingual("sheet.wire-is", kerf=f"{mm(wire['kerf_um']):g}", **sizes))
    if report["taper"] is not None:
        yield Fact(bilingual("sheet.taper"), _taper(run, report["taper"]))
        yield Fact(bilingual("sheet.planes"), _planes(report["taper"]))
    yield Fact(bilingual("sheet.offset"), _offset(report))
    yield Fact(bilingual("sheet.passes"), _passes(report))
    yield Fact(bilingual("sheet.length"), bilingual("sheet.length-is", length=f"{mm(run.ran_um):,.3f}"))
    yield Fact(bilingual("sheet.time"), _time(run))
    if report["taper"] is not None:
        yield Fact(bilingual("sheet.four-axes"), lasting(report["taper"]["time_s"]))
    yield Fact(bilingual("sheet.pieces"), _pieces(pieces))


def _taper(run: DryRun, taper: TaperEntry) -> Bilingual:
    """What is to be set at the control where the program does not say it, and how far U and V go."""
    settings, most = run.scenario.taper, f"{mm(taper['uv_most_um']['corner']):.3f}"
    if settings is None or not settings.angle_rad:
        name = "two" if taper["angle_deg"] is None else "told"
        return bilingual(f"sheet.taper-{name}", angle=f"{taper['angle_deg'] or 0.0:g}", most=most)
    return bilingual(f"sheet.taper-{settings.side.name.lower()}", angle=f"{taper['angle_deg']:g}", most=most)


def _planes(taper: TaperEntry) -> Bilingual:
    z_mm = {plane["plane"]: plane["z_mm"] for plane in taper["planes"]}
    return bilingual(
        "sheet.planes-assumed" if taper["guides_assumed"] else "sheet.planes-are",
        program=f"{z_mm['program']:g}",
        below=f"{-z_mm['lower-guide']:g}",
        above=f"{z_mm['upper-guide'] - z_mm['top']:g}",
    )


def _work(thickness_mm: float, density_g_cm3: float) -> Bilingual:
    key = "sheet.work-as-steel" if density_g_cm3 == DEFAULT_DENSITY_G_CM3 else "sheet.work-is"
    return bilingual(key, thickness=f"{thickness_mm:g}", density=f"{density_g_cm3:g}")


def _offset(report: ReportDocument) -> Bilingual:
    offset = report["offset"]
    if offset is None:
        within_um = reached(report, "program.header").get("offset_um")
        return bilingual("sheet.offset-within", by=mm_text(within_um)) if within_um else bilingual("sheet.offset-none")
    by = ", ".join(f"{mm(each['by_um']):.3f}" for each in offset["passes"])
    return bilingual(f"sheet.offset-{offset['side']}", by=by)


def _passes(report: ReportDocument) -> Bilingual:
    """How many over the contour with the most; their distances too where the program has them within its path."""
    found = report["passes"]
    most = max(found, key=lambda each: each["number"], default=None)
    if most is None or most["number"] == 1 or report["offset"] is not None:
        return same(1 if most is None else most["number"])
    by = ", ".join(mm_text(each["offset_um"]) for each in found if each["contour"] == most["contour"])
    return bilingual("sheet.passes-by", n=most["number"], by=by)


def _time(run: DryRun) -> Bilingual:
    jumping_s = float(run.block_time_s[run.toolpath.is_jump].sum())
    if not jumping_s:
        return lasting_within(run.ran_s, run.time_s, run.scenario.technology)
    whole = lasting_within(run.ran_s, run.time_s, run.scenario.technology)
    return bilingual("sheet.time-is", total=whole, cutting=lasting(run.ran_s - jumping_s))


def _pieces(pieces: Pieces) -> Bilingual:
    if pieces == NO_PIECES:
        return bilingual("sheet.pieces-unknown")
    if not pieces.freed:
        return bilingual("sheet.pieces-none")
    by_kind = {kind: [each for each in pieces.freed if each.kind == kind] for kind in ("part", "slug")}
    return listed(_weighed(kind, found) for kind, found in by_kind.items() if found)


def _weighed(kind: str, pieces: Sequence[Piece]) -> Bilingual:
    return bilingual(
        "sheet.pieces-of", count=numbered({kind: len(pieces)}), mass=_mass(sum(piece.mass_g for piece in pieces))
    )


def _mass(mass_g: float) -> str:
    return f"{mass_g:,.1f} g" if mass_g >= 1.0 else f"{mass_g * 1e3:,.0f} mg"


def _thread(entry: ThreadPointEntry, names: BlockNames) -> Thread:
    first, last = (names.at(number) for number in entry["blocks"])
    x, y, out_x, out_y = map(mm_text, (*entry["at_um"], *entry["out_um"]))
    reach = tuple(map(mm_text, (entry["left_um"], entry["right_um"], entry["down_um"], entry["up_um"])))
    blocks = first if first == last else f"{first}–{last}"
    return Thread(blocks, x, y, _after(entry["at_s"]), reach, out_x, out_y, _after(entry["out_s"]))


def _after(time_s: float | None) -> Bilingual:
    return bilingual("sheet.not-reached") if time_s is None else lasting(time_s)
