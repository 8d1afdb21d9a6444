"""What a foreign configuration says of a machine, on the terminal: what carries over, and what does not."""

from parser.findings.catalogue import Language
from sim.setup.machine.foreign import ForeignMachine
from sim.show.terminal.layout import paragraph, show, table
from sim.show.texts import Words


def print_foreign(of: ForeignMachine, language: Language) -> None:
    """Print it to stdout."""
    tell = Words(language)
    heads = tuple(tell(f"machine.head-{name}") for name in ("key", "value", "source"))
    rows = table(tell("machine.title", control=of.control, file=of.name), heads, (1,))
    for each in of.carried:
        rows.add_row(each.key, f"{each.value:g}" if isinstance(each.value, float) else each.value, each.source)
    show(rows)
    if not of.carried:
        paragraph(tell("machine.nothing"), "yellow")
    for note in of.dropped:
        paragraph(tell("machine.not", text=tell(f"machine.dropped-{note.name}", **note.values)), "cyan")
