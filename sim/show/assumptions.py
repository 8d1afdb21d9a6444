"""What a run took for granted, in words, for terminal and page."""

from parser.findings.catalogue import Bilingual
from sim.run.dryrun import DryRun, assumptions_of
from sim.setup.key_words import words_of
from sim.setup.machine.machine import SECTIONS
from sim.show.texts import bilingual
from sim.show.texts.phrases import as_read, listed, machine_name


def taken_for_granted(run: DryRun) -> list[Bilingual]:
    """A sentence for each: how the program was read, the machine, and what nobody has measured or looked at."""
    found = assumptions_of(run)
    lines = [bilingual("assumptions.program", parts=as_read(found.program))] if found.program else []
    key = "by-default" if found.by_default else "chosen"
    lines.append(bilingual(f"assumptions.{key}", machine=machine_name(found.machine)))
    if found.values:
        names = {key.name: words_of(section, key).name for section in SECTIONS for key in section.keys}
        lines.append(
            bilingual("assumptions.values", count=len(found.values), values=listed(names[key] for key in found.values))
        )
    if not found.compared:
        lines.append(bilingual("assumptions.no-drawing"))
    if not found.wire_bows:
        lines.append(bilingual("assumptions.straight"))
    return lines
