"""The offset path as a toolpath, to be stepped like any other."""

from dataclasses import fields

import numpy as np

from controller.offset.path import Made, OffsetPath
from controller.offset.words import stepped_words
from parser.geometry.curves import Curves
from parser.toolpath import Toolpath


def offset_toolpath(toolpath: Toolpath, path: OffsetPath) -> Toolpath:
    """Toolpath of the offset `path` of a `toolpath`: its exact curves, and words of whole µm to step them by.

    Every row bears the source of the block that it comes from, stops stand where they stood among these. Printed ends
    are those of blocks without offset alone.
    """
    row = path.source_row
    as_it_is = (path.made == Made.AS_IT_IS)[:, None]
    return Toolpath(
        **{field.name: getattr(path.curves, field.name) for field in fields(Curves)},
        printed_end_um=np.where(as_it_is, toolpath.printed_end_um[row], np.nan),
        words=stepped_words(path.curves),
        source=toolpath.source.picked(row),
        stops=tuple(stop._replace(after=int(np.searchsorted(row, stop.after))) for stop in toolpath.stops),
    )
