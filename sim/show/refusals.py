"""Why no program is made of a drawing, in words."""

from collections.abc import Sequence

from parser.findings.catalogue import Bilingual
from parser.text.encoding import printable
from parser.units import mm
from sim.make.cam.model import Refusal
from sim.show.texts import bilingual
from sim.show.texts.phrases import same

_MOST_PLACES = 5


def why_refused(refusal: Refusal) -> Bilingual:
    """The text of a refusal, its places behind it."""
    values = {name: same(printable(value)) for name, value in refusal.values}
    why = bilingual(f"program.refused-{refusal.why}", **values)
    if not refusal.places_um:
        return why
    return bilingual("program.at", what=why, places=places_said(refusal.places_um))


def places_said(places_um: Sequence[tuple[float, float]]) -> Bilingual:
    """Places in mm, the first few of many."""
    named = ", ".join(place_text(place) for place in places_um[:_MOST_PLACES])
    more = len(places_um) - _MOST_PLACES
    if more > 0:
        return bilingual("program.places-more", places=named, more=f"{more:,}")
    return bilingual("program.places-all", places=named)


def place_text(place: tuple[float, float]) -> str:
    """A place in mm, such as ``(12.5, -3)``."""
    x, y = (round(mm(value), 3) + 0.0 for value in place)
    return f"({x:g}, {y:g})"
