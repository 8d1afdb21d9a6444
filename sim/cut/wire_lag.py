"""Wire lag: where a wire that bows back behind its guides cuts.

The discharges press the middle of the wire back against its advance, always with about the same force, and its
tension pulls it toward the line of its guides. So it advances only where it hangs behind by the full lag, and then
straight toward the guides; nearer to them it stays where it has cut, for the slot behind it is open. That is dragging
a load on a rope: in the plane the way of the wire is the tractrix of the way of its guides, and where the rope is slack
the sweeping process by a disc (J. J. Moreau, J. Differential Equations 26 (1977) 347). We assume that the force keeps
its amount in every turn. What the lag does was measured on parts by A. B. Puri, B. Bhattacharyya, Int. J. Machine Tools
& Manufacture 43 (2003) 151, on straight cuts by S. K. Sinha, Int. J. Engineering Science and Technology 2 (2010) 6622,
and on circles by S. Sarkar et al., Precision Engineering 35 (2011) 339.

* Straight on, it runs exactly behind its guides.
* Round a corner of φ₀ ≤ 90° it turns as tan(φ/2) = tan(φ₀/2) e^(−s/lag) over the way s of the guides.
* Past a turn of more than 90° it waits until the guides are at the full lag again, 2 lag |cos φ₀| on, and then turns
  as from a corner of π − φ₀.
* When the guides go round a circle of R > lag, it comes to the circle of √(R² − lag²). When R ≤ lag it cuts no circle:
  it winds inward, and stays where the guides no longer reach the full lag from it.
"""

from dataclasses import replace
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from parser.geometry.curves import Bools, Floats
from parser.toolpath import Toolpath
from sim.table.trace import Trace

Complexes = NDArray[np.complex128]
_Entry = TypeVar("_Entry", bound=np.generic)

_AGREE_UM = 1e-9
"""A stretch may begin this far from where the one before it ended: two wires on the same way never move apart."""


class _Moves(NamedTuple):
    """Moves of the guides, (w, c): c stretches side by side, each of w moves one after the other.

    `length_um` and the unit direction `toward`, x + iy; whether the wire `cuts`, and so keeps its bow.
    """

    length_um: Floats
    toward: Complexes
    cuts: Bools

    def of(self, stretches: Bools) -> "_Moves":
        """Some of the stretches."""
        return _Moves(self.length_um[:, stretches], self.toward[:, stretches], self.cuts[:, stretches])


def bowed(trace: Trace, toolpath: Toolpath, lag_um: Floats) -> Trace:
    """The trace with the place of a wire that bows back by up to `lag_um` (n,), row by row of the toolpath.

    The table is where the guides are. Rows of a pass with another lag are those of a wire that has it all the way.

    At the start of a cut the wire is straight. On jumps there is no discharge, and it goes with its guides. Between
    two samples the guides move straight. For that the wire's way is exact, and so it depends on no step size. The
    guides' way has steps of 1 µm, and a lag much longer than that smooths them.
    """
    if not lag_um.any():
        return trace
    of_sample, cuts = lag_um[trace.row], ~toolpath.is_jump[trace.row]
    behind = np.zeros_like(trace.table_um)
    for lag in np.unique(of_sample[of_sample > 0.0]).tolist():
        behind = np.where((of_sample == lag)[:, None], _behind(trace.table_um, cuts, lag), behind)
    return replace(trace, wire_um=trace.table_um - behind)


def _behind(guides_um: Floats, cuts: Bools, lag_um: float) -> Floats:
    """How far (n, 2) the guides stand before the wire at each of n samples.

    The samples are cut into stretches that are worked out side by side, each from a straight wire at first, then again
    from where the one before it ended until that changes nothing. A few lags of cut forget how they began, so it
    takes a few rounds; after as many rounds as stretches it is exact whatever happens.
    """
    moves = _stretches(guides_um, cuts)
    begins = np.zeros(moves.cuts.shape[1], dtype=np.complex128)
    behind = _drag(moves, begins, lag_um)
    while True:
        before = np.append(0.0, behind[-1, :-1])
        wrong = np.abs(before - begins) > _AGREE_UM
        if not wrong.any():
            break
        begins[wrong] = before[wrong]
        behind[:, wrong] = _drag(moves.of(wrong), begins[wrong], lag_um)
    ordered = behind.T.ravel()[: len(cuts)]
    return np.stack([ordered.real, ordered.imag], axis=1)


def _stretches(guides_um: Floats, cuts: Bools) -> _Moves:
    """The moves cut into stretches, about as many as each has moves; the last is filled up with moves of no length."""
    n = len(cuts)
    width = int(np.ceil(np.sqrt(n)))
    filled = -(-n // width) * width
    by = np.zeros(filled, dtype=np.complex128)
    by[1:n] = np.diff(guides_um[:, 0]) + 1j * np.diff(guides_um[:, 1])
    length = np.abs(by)
    toward = by / np.where(length > 0.0, length, 1.0)
    is_cut = np.concatenate([cuts, np.ones(filled - n, dtype=bool)])
    return _Moves(_side_by_side(length, width), _side_by_side(toward, width), _side_by_side(is_cut, width))


def _side_by_side(column: NDArray[_Entry], width: int) -> NDArray[_Entry]:
    return np.ascontiguousarray(column.reshape(-1, width).T)


def _drag(moves: _Moves, behind: Complexes, lag_um: float) -> Complexes:
    """How far, x + iy, the guides stand before the wire after each move (w, c), from `behind` (c,) at the start."""
    after = np.empty(moves.toward.shape, dtype=np.complex128)
    for step, (length, toward, cuts) in enumerate(zip(*moves, strict=True)):
        behind = after[step] = _moved(behind, length, toward, lag_um) * cuts
    return after


def _moved(behind: Complexes, length: Floats, toward: Complexes, lag_um: float) -> Complexes:
    """The same after one straight move of each stretch."""
    seen = behind * toward.conj()  # along the move, and across it
    aside = np.clip(seen.imag, -lag_um, lag_um)
    taut = np.sqrt((lag_um - aside) * (lag_um + aside))  # along the move, when the full lag is reached
    pulled = length - (taut - seen.real)
    turn = aside / (lag_um + taut) * np.exp(-np.maximum(pulled, 0.0) / lag_um)  # tan(φ/2)
    trailing = lag_um * (1.0 + 1j * turn) ** 2 / (1.0 + turn * turn)
    after: Complexes = np.where(pulled > 0.0, trailing, seen + length) * toward + behind * (length == 0.0)
    return after
