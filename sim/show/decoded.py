"""A decoded block in words, for terminal and page: what each word sets, and the way of the block, in named lines."""

from collections.abc import Iterator
from typing import Final, NamedTuple

from controller.decode.blocks import Decoded, Way
from controller.decode.document import plain
from parser.dialect.decoding import UNREAD, DecodedBlock, DecodeStep
from parser.findings.catalogue import Bilingual
from parser.toolpath import Point
from parser.units import mm, mm_text
from sim.show.texts import bilingual
from sim.show.texts.phrases import same

_CIRCLED_ONE: Final = 0x2460
_CIRCLED: Final = 20
_SIDE_FIELD: Final = "G0.D7D6"


class Named(NamedTuple):
    """A text, and what it is about."""

    name: Bilingual
    text: Bilingual


def order_text(order: int) -> str:
    """Number of a step: in a circle, as the course writes it, or in brackets where there is none."""
    return chr(_CIRCLED_ONE + order - 1) if order <= _CIRCLED else f"({order})"


def word_text(step: DecodeStep) -> Bilingual:
    """The word of a step as written, or what stands for it."""
    return same(step.word) if step.word else bilingual("decode.line-end")


def value_text(step: DecodeStep) -> Bilingual:
    """What the field of a step becomes."""
    if step.value is None:
        return bilingual(f"decode.{_why_without(step)}")
    value = plain(step.value)
    if step.field == "buf_state":
        return bilingual("decode.ready")
    if step.field == "block_num" and value is not None:
        return bilingual("decode.number", number=value, bcd=f"0x{value:02d}")
    if step.field == _SIDE_FIELD:
        return same(f"{int(step.value):02b}")
    if step.field == "G1":
        return bilingual("decode.no-bit", value=value)
    return bilingual("decode.um", um=value) if step.field.startswith("COOR") or "=" in step.word else same(value)


def _why_without(step: DecodeStep) -> str:
    """Why a step has no value."""
    if step.field == UNREAD:
        return "unread"
    return "summed" if step.field[-1].isdecimal() else "no-field"


def buffer_text(block: DecodedBlock) -> str:
    """The fields that a block fills, in their order in the buffer."""
    return "  ".join(_fields(block))


def way_texts(decoded: Decoded) -> tuple[Named, ...]:
    """What is in force in a block, where its contour ends, where its end lies moved aside, and how it is joined."""
    return tuple(Named(bilingual(f"decode.{name}"), text) for name, text in _way_texts(decoded))


def _fields(block: DecodedBlock) -> Iterator[str]:
    if block.number_bcd is not None:
        yield f"block_num=0x{block.number_bcd:02x}"
    for step in block.steps:
        if step.field.startswith("COOR"):
            yield f"{step.field}={plain(step.value)}"
    for name in "fs":
        value = getattr(block, name)
        if value is not None:
            yield f"{name.upper()}={plain(value)}"
    yield f"G0=0x{block.g0:02x} ({block.g0:08b})"
    if block.m:
        yield f"M0={','.join(str(plain(value)) for value in block.m)}"
    for name in "tdh":
        value = getattr(block, name)
        if value is not None:
            yield f"{name.upper()}={plain(value)}"


def _way_texts(decoded: Decoded) -> Iterator[tuple[str, Bilingual]]:
    force, way = decoded.block.in_force, decoded.way
    if force is None:
        yield "force", bilingual("decode.never")
        return
    feed = [] if force.f is None else [f"F{plain(force.f)}"]
    yield "force", same(" ".join(filter(None, [force.motion, force.distance, force.side, force.register, *feed])))
    if way is None:
        return
    runs = bilingual("decode.runs", runs=way.runs) if way.runs > 1 else same("")
    yield "contour", _joined(_contour(way), runs)
    if way.left_um is not None and way.right_um is not None:
        ends = {"left": _place(way.left_um, 4), "right": _place(way.right_um, 4)}
        yield (
            "aside",
            bilingual("decode.ends", **ends, register=force.register, offset=f"{mm(force.offset_um or 0.0):g}"),
        )
    elif force.side != "G40":
        yield "aside", bilingual("decode.unknown", register=force.register or "D0")
    if way.wire_center_um is not None:
        yield "path", bilingual("decode.on-path", place=_place(way.wire_center_um, 4))
    if way.joint != "none":
        yield "joint", bilingual(f"decode.joint-{way.joint}", line=way.before_line)


def _contour(way: Way) -> Bilingual:
    ends = {"start": _place(way.start_um), "end": _place(way.end_um)}
    return bilingual(f"decode.way-{way.kind}", **ends, length=f"{mm(way.length_um):.4f}")


def _place(place: Point, digits: int = 3) -> str:
    """A place in mm, without −0."""
    x, y = (mm_text(value, digits) for value in place)
    return f"({x}, {y})".replace("-", "−")


def _joined(this: Bilingual, other: Bilingual) -> Bilingual:
    return Bilingual(this.en + other.en, this.zh + other.zh)
