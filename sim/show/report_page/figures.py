"""Key figures of a run: what it is called, its value as the report has it, and a word beside it."""

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from parser.units import mm
from sim.run.dryrun import DryRun
from sim.setup.quiz import Said
from sim.show.report_page.tables import reached
from sim.show.words.report import lasting, numbered, said, same

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
    shown, unit
        As people read it.
    beside
        What else there is to say.
    """

    name: Said
    entry: str
    value: float
    shown: Said
    unit: str = ""
    beside: Said = _NONE


def key_figures(run: DryRun, report: Mapping[str, Any]) -> list[Figure]:
    """The figures that stand at the top of the page."""
    return [
        *_size(run, report),
        _steps(report),
        *_worst(report),
        *_closure(run, report),
        *_pieces(report),
        *_drawing(report),
        *_offset(report),
    ]


def time_figures(report: Mapping[str, Any]) -> list[Figure]:
    """The time estimate in its parts."""
    times = zip(report["time_s"]["by_block"], report["blocks"], strict=True)
    jumping = sum(time_s for time_s, block in times if block["kind"] == "jump")
    total = report["time_s"]["total"]
    parts = {"cutting-time": total - jumping, "jump-time": jumping}
    return [
        *(Figure(said(name), "", round(time_s, 6), lasting(time_s)) for name, time_s in parts.items()),
        Figure(said("total-time"), "time_s.total", total, lasting(total)),
    ]


def _figure(name: str, report: Mapping[str, Any], entry: str, digits: int = 0, per: float = 1.0) -> Figure:
    value = reached(report, entry)
    return Figure(said(name), entry, value, same(f"{value / per:,.{digits}f}"))


def _size(run: DryRun, report: Mapping[str, Any]) -> Iterator[Figure]:
    total = report["time_s"]["total"]
    work = said("in-work", thickness=f"{report['work']['thickness_mm']:g}", machine=report["machine"]["name"])
    yield Figure(said("time"), "time_s.total", total, lasting(total), beside=work)
    jumps, arcs = int(run.toolpath.is_jump.sum()), int(run.toolpath.is_arc.sum())
    kinds = numbered({"lines": len(run.toolpath) - arcs - jumps, "arcs": arcs, "jumps": jumps})
    yield _figure("blocks", report, "summary.blocks")._replace(beside=kinds)
    length = _figure("path-length", report, "summary.length_um", 3, 1000.0)
    yield length._replace(unit="mm", beside=said("jumps-included") if jumps else _NONE)


def _steps(report: Mapping[str, Any]) -> Figure:
    return _figure("steps", report, "summary.steps")._replace(beside=said(report["interpolator"]["name"]))


def _worst(report: Mapping[str, Any]) -> Iterator[Figure]:
    where = report["deviation"]["wire"]["where"]
    if where is not None:
        place = said("at-place", block=where["block"], x=_mm(where["x_um"]), y=_mm(where["y_um"]))
        figure = _figure("worst-deviation", report, "deviation.wire.max_um", 2)
        yield figure._replace(unit="µm", beside=place)


def _closure(run: DryRun, report: Mapping[str, Any]) -> Iterator[Figure]:
    """The worst closure as stepped; open contours are worse than any that return."""
    closing = [at for at, contour in enumerate(run.contours) if contour.encloses]
    if not closing:
        return
    at = max(closing, key=lambda at: (run.contours[at].is_open, run.contours[at].closure_stepped_um))
    contour = report["contours"][at]
    told: dict[str, object] = {"exact": f"{contour['closure_exact_um']:,.2f}"}
    if len(run.contours) > 1:
        told |= {"n": len(run.contours), "first": contour["first_block"], "last": contour["last_block"]}
    beside = said("closure-worst" if len(run.contours) > 1 else "closure-exact", **told)
    yield _figure("closure", report, f"contours.{at}.closure_stepped_um", 2)._replace(unit="µm", beside=beside)


def _pieces(report: Mapping[str, Any]) -> Iterator[Figure]:
    if report["remains"] is not None:
        kinds = [piece["kind"] for piece in report["remains"]["pieces"]]
        beside = numbered({"parts": kinds.count("part"), "slugs": kinds.count("slug")})
        yield Figure(said("pieces"), "", len(kinds), same(len(kinds)), beside=beside)


def _drawing(report: Mapping[str, Any]) -> Iterator[Figure]:
    if report["drawing"] is not None:
        allowed = said("allowed", tolerance=f"{report['drawing']['tolerance_um']:g}")
        yield _figure("off-drawing", report, "drawing.max_um", 2)._replace(unit="µm", beside=allowed)


def _offset(report: Mapping[str, Any]) -> Iterator[Figure]:
    if report["offset"] is not None:
        side = said(f"side-{report['offset']['side']}")
        yield _figure("offset-added", report, "offset.by_um", 3, 1000.0)._replace(unit="mm", beside=side)


def _mm(length_um: float) -> str:
    """Millimetres to the µm; never −0."""
    return f"{round(mm(length_um), 3) + 0.0:.3f}"
