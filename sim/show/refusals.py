"""Why no program is made of a drawing, and what a run took for granted, in words.

What a run took for granted, in words, for terminal and page.
"""

from collections.abc import Iterable, Sequence

from parser.findings.catalogue import Bilingual
from parser.text.encoding import printable
from parser.units import mm
from sim.make.cam.model import Refusal
from sim.run.dryrun import DryRun, assumptions_of
from sim.setup.key_words import words_of
from sim.setup.machine.machine import SECTIONS, MeasuredValue
from sim.setup.toml.keys import Key, Section
from sim.setup.wire import CUT_OFF_OF_90, USUAL_LAG_UM
from sim.show.texts import bilingual
from sim.show.texts.phrases import as_read, listed, machine_name, same

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


def machine_values(keys: Sequence[str]) -> Bilingual:
    """Values of a machine by their names, for keys such as ``saddle_mass_kg``."""
    names = {key.name: words_of(section, key).name for section in SECTIONS for key in section.keys}
    return listed(names[key] for key in keys)


def measured_figures(measured: Iterable[MeasuredValue]) -> Bilingual:
    """Values of a machine that were measured, each with its margin and unit."""
    keys = {key.name: (section, key) for section in SECTIONS for key in section.keys}
    return listed(_figure(*keys[each.key], each) for each in measured)


def _figure(section: Section, key: Key, measured: MeasuredValue) -> Bilingual:
    name = words_of(section, key).name
    figure = f"{measured.value:.6g} ± {measured.within:.2g} {key.kind.unit}".rstrip()
    return Bilingual(f"{name.en} {figure}", f"{name.zh} {figure}")


def _usual_lag() -> dict[str, float]:
    """What wires usually lag, and by how much that cuts a corner of 90° off, µm."""
    least, most = USUAL_LAG_UM
    return {"least": least, "most": most, "least_cut": CUT_OFF_OF_90 * least, "most_cut": CUT_OFF_OF_90 * most}


def taken_for_granted(run: DryRun) -> list[Bilingual]:
    """A sentence for each: how the program was read, the machine, and what nobody has measured or looked at."""
    found = assumptions_of(run)
    lines = [bilingual("assumptions.program", parts=as_read(found.program))] if found.program else []
    key = "by-default" if found.by_default else "chosen"
    lines.append(bilingual(f"assumptions.{key}", machine=machine_name(found.machine)))
    if found.values:
        lines.append(bilingual("assumptions.values", count=len(found.values), values=machine_values(found.values)))
    if found.measured:
        lines.append(bilingual("assumptions.measured", values=measured_figures(found.measured)))
    if not found.compared:
        lines.append(bilingual("assumptions.no-drawing"))
    if not found.wire_bows:
        lines.append(bilingual("assumptions.straight", **_usual_lag()))
    if run.process is not None:
        lines.append(bilingual("sparks.model"))
    return lines
