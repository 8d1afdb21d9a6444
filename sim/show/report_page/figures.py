"""The verdict in a sentence, and key figures: what each is called, its value in the report, and a word beside it."""

from collections import Counter
from collections.abc import Iterator
from typing import NamedTuple

from parser.findings.catalogue import LANGUAGES, Bilingual, length, texts
from parser.findings.codes import Severity
from parser.findings.findings import Finding
from parser.units import mm, mm_text
from sim.run.dryrun import DryRun
from sim.run.findings import outcome
from sim.run.report.model import ReportDocument
from sim.show.report_page.tables import reached
from sim.show.texts import bilingual
from sim.show.texts.phrases import by_no_cut, catalogued, lasting, listed, machine_name, numbered, same, technology_name

_NONE = same("")


class Figure(NamedTuple):
    """One figure.

    Attributes
    ----------
    name
        What it is.
    entry
        Its place in report.json: keys and list indices joined with dots; empty where it is counted from several.
    value
        As the report has it.
    value_text, unit
        As people read it.
    note
        What else there is to say.
    """

    name: Bilingual
    entry: str
    value: float
    value_text: Bilingual
    unit: str = ""
    note: Bilingual = _NONE


def why(run: DryRun) -> list[Bilingual]:
    """Sentences on the verdict, the first of them why it is so."""
    return [_first(run), *_ended(run), *_incomplete(run)]


def key_figures(run: DryRun, report: ReportDocument) -> list[Figure]:
    """The figures that stand at the top of the page."""
    return [
        *_size(run, report),
        _steps(report),
        *_worst(run, report),
        *_closure(run, report),
        *_pieces(report),
        *_drawing(report),
        *_offset(report),
    ]


def time_figures(report: ReportDocument) -> list[Figure]:
    """The time estimate in its parts."""
    times = zip(report["time_s"]["by_block"], report["blocks"], strict=True)
    jumping = sum(time_s for time_s, block in times if block["kind"] == "jump")
    total = report["time_s"]["total"]
    parts = {"cutting-time": total - jumping, "jump-time": jumping}
    return [
        *(Figure(bilingual(f"report.{name}"), "", round(time_s, 6), lasting(time_s)) for name, time_s in parts.items()),
        Figure(bilingual("report.total-time"), "time_s.total", total, lasting(total)),
    ]


def _first(run: DryRun) -> Bilingual:
    if not run.findings:
        return bilingual("report.nothing-found")
    reached = outcome(run.findings)
    if reached == "pass":
        return bilingual("report.no-error", counts=_counts(run.findings))
    is_to_check = reached == "to-check"
    first = next(of for of in run.findings if (of.spoils if is_to_check else of.severity is Severity.ERROR))
    title = Bilingual(*(texts(first, language).title for language in LANGUAGES))
    if is_to_check:
        return bilingual("report.why-to-check", counts=_counts(run.findings), code=first.code, title=title)
    key = "report.why-failed-in" if first.block else "report.why-failed"
    return bilingual(key, counts=_counts(run.findings), code=first.code, title=title, block=first.block_name)


def _counts(findings: tuple[Finding, ...]) -> Bilingual:
    number = Counter(finding.severity for finding in findings)
    return numbered({severity: number[severity] for severity in Severity})


def _ended(run: DryRun) -> list[Bilingual]:
    ended = run.ended
    if ended is None:
        return []
    values = {"axis": ended.axis.name, "block": run.block_names.of_row(ended.row), "time": lasting(ended.t_s)}
    return [bilingual(f"report.ended-{ended.cause}", **values)]


def _incomplete(run: DryRun) -> list[Bilingual]:
    names = [check.name for check in run.coverage.checks if check.state == "incomplete"]
    return [bilingual("report.incomplete", checks=listed(map(catalogued, names)))] if names else []


def _figure(name: str, report: ReportDocument, entry: str, digits: int = 0, per: float = 1.0) -> Figure:
    value = reached(report, entry)
    return Figure(bilingual(f"report.{name}"), entry, value, same(f"{value / per:,.{digits}f}"))


def _size(run: DryRun, report: ReportDocument) -> Iterator[Figure]:
    total = report["time_s"]["total"]
    machine, thickness_mm = machine_name(run.scenario.machine), report["work"]["thickness_mm"]
    work = bilingual("report.in-work", thickness=f"{thickness_mm:g}", machine=machine)
    if run.feeds is None:
        yield Figure(
            bilingual("report.card-time"), "time_s.total", total, lasting(total), note=bilingual("report.card-speeds")
        )
    else:
        note = bilingual("report.time-note", unknown=_how_sure(run), work=work)
        yield Figure(bilingual("report.time"), "time_s.total", total, lasting(total), note=note)
    jumps, arcs = int(run.toolpath.is_jump.sum()), int(run.toolpath.is_arc.sum())
    kinds = numbered({"line": len(run.toolpath) - arcs - jumps, "arc": arcs, "jump": jumps})
    yield _figure("blocks", report, "summary.blocks")._replace(note=kinds)
    length = _figure("path-length", report, "summary.length_um", 3, 1000.0)
    yield length._replace(unit="mm", note=bilingual("report.jumps-included") if jumps else _NONE)


def _how_sure(run: DryRun) -> Bilingual:
    """How sure the time is: by the technology, else by no cut of the machine."""
    technology, time_s = run.scenario.technology, run.time_s
    if technology is None or time_s is None:
        return by_no_cut()
    level = round(100.0 * time_s.level)
    least, most = lasting(time_s.least), lasting(time_s.most)
    return bilingual("time.from-to", least=least, most=most, level=level, name=technology_name(technology))


def _steps(report: ReportDocument) -> Figure:
    return _figure("steps", report, "summary.steps")._replace(
        note=bilingual(f"report.{report['interpolator']['name']}")
    )


def _worst(run: DryRun, report: ReportDocument) -> Iterator[Figure]:
    where = report["deviation"]["wire"]["where"]
    if where is not None:
        block = run.block_names.at(where["block"])
        place = bilingual("report.at-place", block=block, x=mm_text(where["x_um"]), y=mm_text(where["y_um"]))
        figure = _figure("worst-deviation", report, "deviation.wire.max_um", 2)
        yield figure._replace(unit="µm", note=place)


def _closure(run: DryRun, report: ReportDocument) -> Iterator[Figure]:
    """The worst closure as stepped; open contours are worse than any that return."""
    closing = [at for at, contour in enumerate(run.whole_contours) if contour.has_closure]
    if not closing:
        return
    at = max(closing, key=lambda at: (run.whole_contours[at].is_open, run.whole_contours[at].closure_stepped_um))
    contour = report["contours"][at]
    values: dict[str, object] = {"exact": length(contour["closure_exact_um"])}
    if len(run.whole_contours) > 1:
        first, last = (run.block_names.at(contour[key]) for key in ("first_block", "last_block"))
        values |= {"n": len(run.whole_contours), "first": first, "last": last}
    note = bilingual("report.closure-worst" if len(run.whole_contours) > 1 else "report.closure-exact", **values)
    stepped, unit = length(contour["closure_stepped_um"]).split(" ")
    figure = _figure("closure", report, f"contours.{at}.closure_stepped_um")
    yield figure._replace(value_text=same(stepped), unit=unit, note=note)


def _pieces(report: ReportDocument) -> Iterator[Figure]:
    if report["remains"] is not None:
        kinds = [piece["kind"] for piece in report["remains"]["pieces"]]
        note = numbered({kind: kinds.count(kind) for kind in ("part", "slug")})
        yield Figure(bilingual("report.pieces"), "", len(kinds), same(len(kinds)), note=note)


def _drawing(report: ReportDocument) -> Iterator[Figure]:
    top = None if report["taper"] is None else report["taper"]["drawing"]
    of_faces = (("off-drawing", "drawing", report["drawing"]), ("off-drawing-top", "taper.drawing", top))
    for name, key, found in of_faces:
        if found is not None:
            allowed = bilingual("report.allowed", tolerance=f"{found['tolerance_um']:g}")
            yield _figure(name, report, f"{key}.max_um", 2)._replace(unit="µm", note=allowed)


def _offset(report: ReportDocument) -> Iterator[Figure]:
    if report["offset"] is not None:
        side = bilingual(f"report.side-{report['offset']['side']}")
        by = ", ".join(f"{mm(each['by_um']):.3f}" for each in report["offset"]["passes"])
        yield _figure("offset-added", report, "offset.by_um")._replace(value_text=same(by), unit="mm", note=side)
