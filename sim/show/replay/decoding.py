"""How the blocks of a run are decoded, for the page: words, fields, buffers, ways, in both languages."""

from typing import Any

from parser.text.encoding import printable
from sim.decode.blocks import Decoded, decoded
from sim.run.dryrun import DryRun
from sim.show.decoded import buffer_text, order_text, value_text, way_texts, word_text

_MOST = 3000
"""Blocks: a longer program is not one to learn from, and its page would grow by half."""


def decoding(run: DryRun) -> dict[str, Any] | None:
    """Decoded blocks that run, and which of them each row is of; None where there are none, and of long programs."""
    program = run.program
    if program.decoder is None or len(program.toolpath) > _MOST:
        return None
    contour = program.toolpath if run.offset is None else run.offset.passed.drawn
    moving = [one for one in decoded(program, contour) if one.way is not None]
    of_first = {one.block.span[0]: index for index, one in enumerate(moving)}
    return {
        "of_row": [of_first.get(first, -1) for first in program.toolpath.source.span[:, 0].tolist()],
        "blocks": [_entry(program.text, one) for one in moving],
    }


def _entry(text: str, one: Decoded) -> dict[str, Any]:
    return {
        "text": printable(text[slice(*one.block.span)]),
        "steps": [
            {
                "order": order_text(step.order),
                "word": word_text(step)._asdict(),
                "field": step.field,
                "value": value_text(step)._asdict(),
            }
            for step in one.block.steps
        ],
        "buffer": buffer_text(one.block),
        "ways": [{"name": named.name._asdict(), "text": named.text._asdict()} for named in way_texts(one)],
    }
