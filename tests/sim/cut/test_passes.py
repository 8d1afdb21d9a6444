"""What a rough cut and trims leave: sizes of the edges that exist, by the blocks of the pass that made them."""

import math

import numpy as np
import pytest
from paths import Pen
from traced import STEEL, F, exactly, kerf_along, trace_of

from parser.toolpath import Toolpath
from sim.cut.pieces.pieces import Piece, Pieces, pieces_of
from sim.cut.sizes import Sizes, sizes_of

W, H, R = 4000.0, 3000.0, 500.0
OFFSETS = (160.0, 120.0, 100.0)
LOOP = 9  # blocks of a turn: two halves of the bottom side, three sides and four corners


def turn(pen: Pen, by: float, *, back: bool = False) -> Pen:
    """Round a rectangle W × H with corners R about (0, 0), `by` outside of it, from the middle of its bottom."""
    x, y, r, s = W / 2 + by, H / 2 + by, R + by, -1 if back else 1
    centers = [(s * (W / 2 - R), R - H / 2), (s * (W / 2 - R), H / 2 - R)]
    centers += [(-x, y) for x, y in reversed(centers)]
    ends = [(s * (x - r), -y), (s * x, y - r), (-s * (x - r), y), (-s * x, r - y), (0.0, -y)]
    for end, center in zip(ends, [*centers, None], strict=True):
        pen.to(*end)
        if center is not None:
            pen.arc(*center, s * math.pi / 2)
    return pen


def left_by(path: Toolpath, stray=exactly) -> tuple[Pieces, Sizes]:
    kerf = kerf_along(path, trace_of(path, stray=stray))
    pieces = pieces_of(kerf, None, STEEL)
    return pieces, sizes_of(path, kerf, pieces, None, np.zeros((len(path), 2)))


def die(*offsets: float, between: str = "contour", back: bool = False) -> Toolpath:
    pen = Pen()
    for number, by in enumerate(offsets):
        if number and between == "hole":
            pen.to(0, 0)
        if number and between == "jump":
            pen.to(0, 0).jump(0, 0)
        turn(pen.to(0, by - H / 2), -by, back=back and number % 2 == 1)
    return pen.to(0, 0).path()


def last_pass(path: Toolpath) -> set[int]:
    """Block numbers of the last turn; behind it is a lead-out."""
    return set(range(len(path) - LOOP, len(path)))


@pytest.mark.parametrize("between", ["contour", "hole", "jump"])
@pytest.mark.parametrize("back", [False, True])
def test_a_die_has_the_radii_widths_and_box_of_its_last_pass(between, back):
    path = die(*OFFSETS, between=between, back=back)
    pieces, sizes = left_by(path)
    assert {size.block for size in sizes.radii} <= last_pass(path)
    assert [size.what for size in sizes.radii] == ["hole"] * 4
    assert [size.nominal_um for size in sizes.radii] == pytest.approx([R] * 4)
    assert [size.cut_um for size in sizes.radii] == pytest.approx([R] * 4, abs=0.1)
    assert {block for size in sizes.distances for block in size.blocks} <= last_pass(path)
    assert {(size.what, round(size.nominal_um, 3)) for size in sizes.distances} == {("slot", W), ("slot", H)}
    (box,) = sizes.boxes
    assert box.what == "opening"
    assert box.nominal_um == pytest.approx((W, H), abs=0.1)
    assert box.cut_um == pytest.approx((W, H), abs=0.1)
    assert pieces.freed[box.piece].area_mm2 == max(piece.area_mm2 for piece in pieces.freed)
    assert {piece.kind for piece in pieces.freed} == {"slug"}


def punch_with_tab(*offsets: float, tab: float = 600.0, paused: bool = False) -> Toolpath:
    """All but a tab at the end of the bottom side cut there and back, then the tab, by all passes."""
    pen = Pen(0, -H / 2 - 1500)
    for number, by in enumerate(offsets):
        ahead = number % 2 == 0
        turn_open(pen.to(0 if ahead else -tab, -H / 2 - by), by, tab, ahead=ahead)
    ahead = len(offsets) % 2 == 0
    for by in offsets:
        pen.to(-tab if ahead else 0, -H / 2 - by).to(0 if ahead else -tab, -H / 2 - by)
        ahead = not ahead
    return pen.to(0, -H / 2 - 1500).path()


def turn_open(pen: Pen, by: float, tab: float, *, ahead: bool) -> None:
    """A turn that leaves the tab: from (0, …) round to (−tab, …), or back."""
    rows = turn(Pen(0, -H / 2 - by), by).rows
    if ahead:
        pen.rows += rows[:-1]
        pen.x, pen.y = rows[-1][1]
        pen.to(-tab, -H / 2 - by)
        return
    for row in reversed(rows[:-1]):
        (x, y), center, sweep = row[1], row[3], row[6]
        pen.to(*row[2])
        pen.to(x, y) if sweep == 0.0 else pen.arc(*center, -sweep)


@pytest.mark.parametrize("offsets", [OFFSETS, (160.0, 100.0), (180.0, 140.0, 120.0, 100.0)])
def test_a_punch_on_a_tab_has_the_sizes_of_its_last_passes(offsets):
    path = punch_with_tab(*offsets)
    pieces, sizes = left_by(path)
    part = max(pieces.freed, key=lambda piece: piece.area_mm2)
    assert part.kind == "part"
    assert {piece.kind for piece in pieces.freed if piece is not part} <= {"slug"}
    assert part.area_mm2 == pytest.approx(1e-6 * (W * H - (4 - math.pi) * R**2), abs=1e-3)
    assert [size.nominal_um for size in sizes.radii] == pytest.approx([R] * 4)
    assert [size.cut_um for size in sizes.radii] == pytest.approx([R] * 4, abs=0.1)
    assert {(size.what, round(size.nominal_um, 3)) for size in sizes.distances} == {("material", W), ("material", H)}
    (box,) = sizes.boxes
    assert box.cut_um == pytest.approx((W, H), abs=0.1)
    # The bottom side is made by two blocks, beside the tab and over it; both face the top.
    facing = [size.blocks for size in sizes.distances if size.nominal_um == pytest.approx(H)]
    assert len({block for blocks in facing for block in blocks}) >= 3


def test_where_a_trim_is_missing_no_size_of_the_rough_edge_is_told():
    # The trace ends with the rough cut: the ideal path would leave none of its edges.
    path = die(160.0, 100.0)
    trace = trace_of(path)
    cut = trace.until(float(trace.t_s[np.searchsorted(trace.row, LOOP + 1)]) - 1e-6)
    kerf = kerf_along(path, cut)
    pieces = pieces_of(kerf, None, STEEL)
    sizes = sizes_of(path, kerf, pieces, None, np.zeros((len(path), 2)))
    (box,) = sizes.boxes
    assert np.subtract(box.cut_um, box.nominal_um) == pytest.approx((-120.0, -120.0), abs=0.2)
    assert (sizes.radii, sizes.distances) == ((), ())


def test_a_trim_that_the_table_cut_5_um_too_small_shows_in_all_sizes():
    def small(place, row):
        return place * np.where((row > LOOP)[:, None], 1.0 - 5.0 / np.array([W / 2, H / 2]), 1.0)

    _, sizes = left_by(die(160.0, 100.0), small)
    (box,) = sizes.boxes
    off = 10.0 * (1.0 - 2 * F / np.array([W, H]))
    assert np.subtract(box.cut_um, box.nominal_um) == pytest.approx(-off, abs=0.2)
    by = {round(size.nominal_um): size.cut_um - size.nominal_um for size in sizes.distances}
    assert (by[round(W)], by[round(H)]) == pytest.approx(tuple(-off), abs=0.2)


def test_two_passes_on_one_way_are_told_where_each_made_the_edge():
    path = die(160.0, 100.0, 100.0)
    _, sizes = left_by(path, lambda place, row: place + 0.5 * np.sin(0.01 * place[:, ::-1]) * (row[:, None] % 2 - 0.5))
    assert {size.block for size in sizes.radii} <= set(range(LOOP + 3, len(path)))
    assert [size.nominal_um for size in sizes.radii] == pytest.approx([R] * len(sizes.radii))
    assert [size.cut_um for size in sizes.radii] == pytest.approx([R] * len(sizes.radii), abs=2.0)
    assert {round(size.nominal_um) for size in sizes.distances} == {round(W), round(H)}


def closed_punch(*offsets: float, between: str = "contour") -> Toolpath:
    """All passes all round, there and back, or each threaded anew: the rough cut frees it."""
    pen = Pen(0, -H / 2 - 1500)
    for number, by in enumerate(offsets):
        if number and between == "jump":
            pen.to(0, -H / 2 - 1500).jump(0, -H / 2 - 1500)
        turn(pen.to(0, -H / 2 - by), by, back=between == "contour" and number % 2 == 1)
    return pen.to(0, -H / 2 - 1500).path()


def largest(path: Toolpath, pauses: tuple[int, ...] = ()) -> Piece:
    return max(pieces_of(kerf_along(path), None, STEEL, pauses).freed, key=lambda piece: piece.area_mm2)


@pytest.mark.parametrize("between", ["contour", "jump"])
def test_a_punch_that_its_rough_cut_frees_is_loose_while_it_is_trimmed(between):
    """Also where trims of their own leave nothing of the edge that the rough cut made."""
    part = largest(closed_punch(*OFFSETS, between=between))
    perimeter = 2 * (W + H - 4 * R) + 2 * math.pi * (R + 120)
    assert (part.early, part.freed.contour) == (True, 1)
    assert part.cut_after_um == pytest.approx(2 * perimeter, rel=0.02)
    assert part.held_after_block is None


def test_a_die_may_lose_its_slug_before_its_trims():
    for between in ("contour", "hole", "jump"):
        slug = largest(die(*OFFSETS, between=between))
        assert (slug.kind, slug.freed.block, slug.early) == ("slug", LOOP + 1, False)


def test_a_pause_before_the_tab_is_where_the_piece_is_held():
    path = punch_with_tab(*OFFSETS)
    tab = len(path) - 7  # blocks before the way to the tab, three passes over it, two short steps and the lead-out
    loose, held = largest(path), largest(path, (tab,))
    assert (loose.early, loose.held_after_block) == (True, None)
    assert (held.early, held.held_after_block) == (False, tab)
    assert held.cut_after_um == loose.cut_after_um


@pytest.mark.parametrize("pauses", [(0,), (1,), (2,)])
def test_a_pause_before_most_of_the_edge_is_cut_holds_nothing(pauses):
    assert largest(closed_punch(*OFFSETS), pauses).early
    assert largest(closed_punch(*OFFSETS), pauses).held_after_block is None


def test_a_pause_once_it_is_free_comes_too_late():
    assert largest(closed_punch(*OFFSETS), (LOOP + 1,)).held_after_block is None


def test_the_scrap_between_two_leads_is_waste():
    pen = turn(Pen(0, -H / 2 - 1500).to(0, -H / 2 - F), F)
    pen.to(-800, -H / 2 - F).to(0, -H / 2 - 1500)
    part, scrap = sorted(pieces_of(kerf_along(pen.path()), None, STEEL).freed, key=lambda piece: -piece.area_mm2)
    assert (part.kind, scrap.kind) == ("part", "slug")


@pytest.mark.parametrize("kind", ["punch", "die"])
def test_a_band_that_no_pass_cuts_is_waste(kind):
    """Rough and trim 230 µm apart, with a kerf of 200 µm."""
    path = closed_punch(330.0, 100.0) if kind == "punch" else die(330.0, 100.0)
    pieces, sizes = left_by(path)
    main, band = sorted(pieces.freed, key=lambda piece: -piece.area_mm2)[:2]
    assert (main.kind, band.kind) == ("part" if kind == "punch" else "slug", "slug")
    assert band.area_mm2 == pytest.approx(0.03 * (2 * (W + H - 4 * R) + 2 * math.pi * R) * 1e-3, rel=0.15)
    (box,) = sizes.boxes
    assert box.what == ("part" if kind == "punch" else "opening")
    assert box.cut_um == pytest.approx((W, H), abs=0.1)
    assert [size.nominal_um for size in sizes.radii] == pytest.approx([R] * 4)


def test_an_opening_is_told_once_however_many_pieces_its_slug_falls_into():
    # Trims that begin elsewhere cut the slug in two.
    pen = turn(Pen().to(0, 160 - H / 2), -160.0).to(0, 0).to(0, H / 2 - 100).to(0, 100 - H / 2)
    pieces, sizes = left_by(turn(pen, -100.0).to(0, 0).path())
    assert [piece.kind for piece in pieces.freed] == ["slug"] * 2
    (box,) = sizes.boxes
    assert (box.what, box.nominal_um) == ("opening", pytest.approx((W, H), abs=0.1))


def test_halves_of_a_loose_piece_came_free_with_it_and_a_slug_in_it_by_its_own_kerf():
    pen = turn(Pen(0, -H / 2 - 1500).to(0, -H / 2 - F), F)
    freeing = LOOP + 1
    halves = pieces_of(kerf_along(pen.to(0, H / 2 + 500).path()), None, STEEL).freed
    assert [piece.freed.block for piece in halves] == [freeing] * 2
    assert halves[0].freed.t_s == halves[1].freed.t_s
    pen = turn(Pen(0, -H / 2 - 1500).to(0, -H / 2 - F), F).jump(0, 0).to(500, 0).arc(0, 0, 2 * math.pi)
    part, slug = pieces_of(kerf_along(pen.path()), None, STEEL).freed
    assert (part.kind, part.freed.block, slug.kind, slug.freed.block) == ("part", freeing, "slug", freeing + 3)
