"""What came of a program for the card."""

from typing import Any, NamedTuple

from sim.clients.run import Read
from sim.clients.started import Ended
from sim.run.dryrun import DryRun


class ClientRun(NamedTuple):
    """What came of a program for the card.

    Attributes
    ----------
    read
        Its calls, what the card did, and what it did not look at.
    ended
        How it ended.
    run
        The table under its pulses; None where neither X nor Y moved.
    report
        All of it as ``report.json`` has it.
    """

    read: Read
    ended: Ended
    run: DryRun | None
    report: dict[str, Any]
