"""Subclass marks for entities that are bare group codes, as ezdxf asks for them.

Releases since R13 divide the group codes of an entity by marks, group code 100, such as ``AcDbSpline``. Small programs
write the codes alone, often the ENTITIES section alone, and whoever reads by codes needs no marks. ezdxf needs them for
some kinds of entities, and refuses the whole file where one of these has none.
"""

from collections.abc import Iterator
from typing import NamedTuple

# Kinds that ezdxf 1.4 does not load bare, with the mark of each as the DXF reference has it.
_MARKS = {
    b"SPLINE": b"AcDbSpline",
    b"HELIX": b"AcDbSpline",
    b"LWPOLYLINE": b"AcDbPolyline",
    b"MTEXT": b"AcDbMText",
    b"HATCH": b"AcDbHatch",
    b"LEADER": b"AcDbLeader",
    b"MULTILEADER": b"AcDbMLeader",
    b"MLEADER": b"AcDbMLeader",
    b"3DSOLID": b"AcDbModelerGeometry",
    b"BODY": b"AcDbModelerGeometry",
    b"REGION": b"AcDbModelerGeometry",
}
# Group codes that all entities have, by the DXF reference; their subclass has none of them.
_COMMON = frozenset(b"5 6 8 48 60 62 67 102 284 330 347 360 370 390".split())
_EXTENDED = 1000  # group codes from here on belong to other programs and stand last


def with_marks(data: bytes) -> bytes:
    """The text of a DXF file with a marked subclass for each bare entity; the same object where none wants any.

    The subclass repeats the codes that the entity has: of releases before R13, ezdxf reads some of them before the mark
    and some behind it.
    """
    lines = data.split(b"\n")
    parts: list[bytes] = []
    last = 0
    for bare in _bare(lines):
        codes = range(bare.first, bare.past, 2)
        own = [line for at in codes if lines[at].strip() not in _COMMON for line in lines[at : at + 2]]
        parts += [*lines[last : bare.past], b"100", b"AcDbEntity", b"100", bare.mark, *own]
        last = bare.past
    return b"\n".join([*parts, *lines[last:]]) if parts else data


class _Bare(NamedTuple):
    """Lines of an entity's group codes, from the first one behind its name to the last one of its own, and its mark."""

    first: int
    past: int
    mark: bytes


def _bare(lines: list[bytes]) -> Iterator[_Bare]:
    """Entities that want marks, in file order."""
    mark, first, past = None, 0, 0
    for at in range(0, len(lines) - 1, 2):
        code = lines[at].strip()
        if code == b"0":
            if mark:
                yield _Bare(first, past, mark)
            mark, first, past = _MARKS.get(lines[at + 1].strip()), at + 2, at + 2
        elif code == b"100":
            mark = None
        elif mark and past == at and not (len(code) == 4 and code.isdigit() and int(code) >= _EXTENDED):
            past = at + 2
    if mark:
        yield _Bare(first, past, mark)
