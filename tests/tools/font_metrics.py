"""Writes ``metrics.json`` beside the font of the pictures: ``PYTHONPATH=. python tests/tools/font_metrics.py``.

Widths and kerning as the font itself has them (tables ``hmtx`` and ``GPOS``), read by fonttools.
"""

import json
from collections import Counter
from pathlib import Path
from typing import Any

from fontTools.ttLib import TTFont

from sim.show.draw.letters import METRICS
from sim.show.draw.style import FONT

KERNED_UP_TO = 0x24F
"""Last letter of the pairs that are kerned: the end of Latin. What follows, Greek but for one, has next to none."""
_PAIRS, _EXTENSION = 2, 9
"""Kinds of lookup in GPOS: pairs, and a table elsewhere (OpenType 1.9, GPOS)."""


def metrics_of(font: Path) -> dict[str, Any]:
    """The metrics of a font; widths in its own units."""
    read = TTFont(font)
    glyphs, widths = read.getBestCmap(), read["hmtx"]
    advances = {chr(code): widths[glyph][0] for code, glyph in sorted(glyphs.items())}
    usual = Counter(advances.values()).most_common(1)[0][0]
    latin = [chr(code) for code in sorted(glyphs) if code <= KERNED_UP_TO]
    rows = {
        left: {right: by for right in latin if (by := kerned(read, glyphs[ord(left)], glyphs[ord(right)]))}
        for left in latin
    }
    return {
        "units_per_em": read["head"].unitsPerEm,
        "usual": usual,
        "advances": {letter: width for letter, width in advances.items() if width != usual},
        "kerning": {left: row for left, row in rows.items() if row},
    }


def kerned(font: TTFont, left: str, right: str) -> int:
    """How far the second glyph of a pair is moved, units of the font: by the first table that knows the pair."""
    table = font["GPOS"].table
    lookups = {at for each in table.FeatureList.FeatureRecord if each.FeatureTag == "kern" for at in _lookups(each)}
    for lookup in sorted(lookups):
        for found in table.LookupList.Lookup[lookup].SubTable:
            pairs = found.ExtSubTable if found.LookupType == _EXTENSION else found
            if pairs.LookupType != _PAIRS or left not in pairs.Coverage.glyphs:
                continue
            by = _of_pair(pairs, left, right) if pairs.Format == 1 else _of_classes(pairs, left, right)
            if by is not None:
                return by
    return 0


def _lookups(feature: Any) -> list[int]:
    of_feature: list[int] = feature.Feature.LookupListIndex
    return of_feature


def _of_pair(pairs: Any, left: str, right: str) -> int | None:
    """Format 1: pairs by name."""
    for record in pairs.PairSet[pairs.Coverage.glyphs.index(left)].PairValueRecord:
        if record.SecondGlyph == right:
            return record.Value1.XAdvance if record.Value1 else 0
    return None


def _of_classes(pairs: Any, left: str, right: str) -> int:
    """Format 2: pairs of classes; it knows every pair whose first glyph it has."""
    first, second = (
        kinds.classDefs.get(glyph, 0) for kinds, glyph in ((pairs.ClassDef1, left), (pairs.ClassDef2, right))
    )
    value = pairs.Class1Record[first].Class2Record[second].Value1
    return getattr(value, "XAdvance", 0) if value else 0


def text_of(metrics: dict[str, Any]) -> str:
    """The file: a line for each letter that is kerned."""
    rows = [f"{_json(left)}: {_json(row)}" for left, row in metrics["kerning"].items()]
    head = [f"{_json(key)}: {_json(value)}" for key, value in metrics.items() if key != "kerning"]
    return ",\n".join(["{\n" + head[0], *head[1:], '"kerning": {\n' + rows[0], *rows[1:]]) + "\n}\n}\n"


def _json(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)


if __name__ == "__main__":
    METRICS.write_text(text_of(metrics_of(FONT)), encoding="utf-8")
