"""``drycut card``."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from parser.text.encoding import printable

if TYPE_CHECKING:
    from controller.card.log.replay import Difference, Replay

SHOWN = 20
"""Differences that are printed; the others are counted."""


@click.group()
def card() -> None:
    """Work with the emulated motion card."""


@card.command()
@click.argument("log", type=click.Path(path_type=Path), metavar="FILE")
@click.option("--json", "as_json", is_flag=True, help="Print the result as JSON.")
def replay(log: Path, as_json: bool) -> None:
    """Replay a log of the card and compare.

    Makes the same calls at the same simulated times, and compares time, answer and status of each, and the end.

    \b
    Exit code: 0 all is equal, 1 something differs, 2 bad use or unreadable input.

    \b
    drycut card replay part.log
    """  # noqa: D301 - click keeps the lines of a paragraph that begins with a backspace
    from controller.card.log.replay import replay_file

    done = replay_file(log)
    shown: list[Difference] = []
    count = 0
    for difference in done:
        count += 1
        if count <= SHOWN:
            shown.append(difference)
    name = printable(str(log))
    click.echo(_json(name, done, count, shown) if as_json else _text(name, done, count, shown))
    raise click.exceptions.Exit(1 if count else 0)


def _text(name: str, done: "Replay", count: int, shown: "list[Difference]") -> str:
    lines = [
        f"{name}:{entry.line}: error: the card differs\n  expected: {entry.expected}\n     found: {entry.found}"
        for entry in shown
    ]
    if count > len(shown):
        lines.append(f"{name}: and {count - len(shown):,} more")
    verdict = f"{count:,} {'difference' if count == 1 else 'differences'}" if count else "equal"
    places = "; ".join(", ".join(f"{place:,}" for place in axes) for axes in done.card.places)
    lines.append(
        f"{name}: {verdict}: {done.calls:,} calls, {done.card.time_s:.6g} s, {done.pulses:,} pulses, "
        f"axes at {places}, status {done.card.status:04x}"
    )
    return "\n".join(lines)


def _json(name: str, done: "Replay", count: int, shown: "list[Difference]") -> str:
    import json

    result = {
        "log": name,
        "equal": count == 0,
        "calls": done.calls,
        "time_s": done.card.time_s,
        "pulses": done.pulses,
        "places": done.card.places,
        "status": f"{done.card.status:04x}",
        "differences": count,
        "first": [entry._asdict() for entry in shown],
    }
    return json.dumps(result, ensure_ascii=False, indent=2)
