"""The cut of a run: where the wire really was, and what it leaves."""

from sim.cut.pieces.pieces import Pieces
from sim.run.dryrun import DryRun
from sim.show.draw.sheet import AnyCanvas, Sheet
from sim.show.pictures.cut.of_path import bodies_of, note_of, travel_um
from sim.show.pictures.cut.picture import Shapes, draw_cut
from sim.show.pictures.cut.subject import Cut
from sim.show.texts import Words
from sim.show.texts.phrases import lasting


def draw_cut_of_run(
    sheet: Sheet[AnyCanvas], run: DryRun, pieces: Pieces | None, shapes: Shapes | None = None
) -> AnyCanvas:
    """Draw the cut of a run, with the pieces that it frees where they are known; with `shapes` of earlier pictures."""
    shapes = shapes or Shapes()
    return draw_cut(sheet, cut_of_run(run, pieces, sheet.say, shapes), shapes)


def cut_of_run(run: DryRun, pieces: Pieces | None, say: Words, shapes: Shapes) -> Cut:
    """The cut of a run, with the pieces that it frees where they are known; `shapes` are those of all its pictures."""
    scenario, sizes = run.scenario, None if run.remains is None else run.remains.sizes
    return Cut(
        toolpath=run.toolpath,
        kerf_um=scenario.wire.kerf_um,
        title=scenario.title_in(say.language),
        note=note_of(run.toolpath, run.offset, run.findings, getattr(lasting(run.ran_s), say.language), say),
        trace=run.cut,
        passes=run.passes if run.has_trims else None,
        contour=None if run.offset is None else run.offset.passed.drawn,
        bodies=bodies_of(scenario),
        pieces=pieces,
        sizes=sizes,
        findings=run.findings,
        travel_um=travel_um(run.toolpath, scenario),
        off=shapes.strips(run.comparison),
        off_sizes=shapes.off_sizes(run.comparison, sizes),
        faces=None if run.tilted is None else run.tilted.path.faces,
    )
