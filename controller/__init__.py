"""Toolpath to pulses: interpolation, the plan of motion in time, and the emulated motion card; a package of drycut."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from controller.card.ge import GECard

__all__ = ["GECard"]


def __getattr__(name: str) -> Any:
    """`GECard`, loaded when it is asked for: a check of a program needs no card."""
    if name != "GECard":
        raise AttributeError(f"module 'controller' has no attribute {name!r}")
    from controller.card.ge import GECard  # noqa: PLC0415

    return GECard
