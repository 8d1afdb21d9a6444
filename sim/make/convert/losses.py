"""What a conversion loses, or writes otherwise, told before anybody misses it."""

import numpy as np

from parser.geometry.curves import CurveKind
from parser.program import Program
from parser.told.step_words import StepWords
from parser.toolpath import Toolpath
from parser.write.draft import Draft, Written
from parser.write.events import OF_THE_FAMILY
from parser.write.losses import CarriedOver, Loss, lost_words, some
from sim.make.convert.wanted import Wanted, carried_events


def losses(program: Program, path: Toolpath, draft: Draft, made: Written, wanted: Wanted) -> tuple[Loss, ...]:
    """What the written text does not have of a program, in the order in which it is told.

    `path` is what was drafted of it, as programmed or as the controller runs it.
    """
    words = program.toolpath.words
    if words is not None:
        of_text = _lost_fields(program, words, wanted)
    else:
        of_text = lost_words(program.text, _carried(program, path, wanted)) if program.decoder is not None else ()
    found = (*of_text, *_lost_offsets(program.toolpath, wanted), *_changed_rows(path, draft, made, wanted))
    return tuple(loss for loss in found if loss.number)


def _carried(program: Program, path: Toolpath, wanted: Wanted) -> CarriedOver:
    """What of the words of an ISO program beside its path is written."""
    if wanted.pmac is not None and wanted.pmac.blocks is not None:
        return CarriedOver(letters="FZ", dwells=True)
    events = carried_events(program, path, wanted)
    if events is None:
        return CarriedOver()
    is_own = not all(event.is_common for event in events)
    return CarriedOver(letters=OF_THE_FAMILY if is_own else "", dwells=True, optional_stops=True)


def _lost_fields(program: Program, words: StepWords, wanted: Wanted) -> tuple[Loss, ...]:
    """What stands in 3B and 4B beside their blocks, and what their words say otherwise than they would be told."""
    longer = np.maximum(words.x_um, words.y_um)
    reduced = (words.turn == 0) & (longer != words.count_um) & (program.toolpath.kind != CurveKind.JUMP)
    header = any(bool(value) for value in program.header.values())
    prints = not bool(np.isnan(program.toolpath.printed_end_um).all())
    return (
        Loss("header", "", int(header and wanted.form != "detailed")),
        Loss("remarks", "", len(program.reading.remarks)),
        Loss("prints", "", int(prints and wanted.form != "detailed")),
        Loss("reduced", "", int(reduced.sum()) if wanted.iso is not None else 0),
        Loss("radii", "", int((words.radius_um > 0).sum()) if wanted.language != "4b" else 0),
    )


def _lost_offsets(toolpath: Toolpath, wanted: Wanted) -> tuple[Loss, ...]:
    told = toolpath.compensation
    if told is None or not told.side.any():
        return ()
    names = [name for name, side in zip(told.register, told.side.tolist(), strict=True) if side]
    if wanted.keeps and wanted.iso is not None:
        return ()
    return (Loss("offsets-left" if wanted.keeps else "offsets-worked-in", some(filter(None, names)), len(set(names))),)


def _changed_rows(path: Toolpath, draft: Draft, made: Written, wanted: Wanted) -> tuple[Loss, ...]:
    """Rows that became no block, more than one, or one of another kind."""
    blocks = np.bincount(made.row, minlength=len(draft))
    is_jump = draft.curves.kind == CurveKind.JUMP
    first = max(len(path) - len(draft), 0)
    ran = is_jump[max(len(draft) - len(path), 0) :]
    rapids = is_jump & ~draft.is_placed & (blocks > 0) & (not wanted.has_rapids and draft.words is None)
    return (
        Loss("first-rapids", "", first),
        Loss("rapids-back", "", int((path.is_jump[first:] & ~ran).sum())),
        Loss("rapids", "", int(rapids.sum())),
        Loss("nothing", "", int((blocks == 0).sum())),
        Loss("split", "", int((blocks > 1).sum())),
    )
