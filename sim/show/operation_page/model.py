"""What the page of drills of operation hands over to its script."""

from typing import TypedDict

from sim.show.panel_page.model import PanelEntry


class OperationDrillEntry(TypedDict):
    """A drill: what happened, the state of the loop then, and the way in twenty seconds from which on a cut goes on."""

    kind: str
    state: list[float]
    least_um: float


class OperationEntry(TypedDict):
    """A set of drills on one cut."""

    set: int
    panel: PanelEntry
    drills: list[OperationDrillEntry]
    kinds: list[str]
    actions: list[str]
