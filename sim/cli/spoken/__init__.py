"""Commands that speak the user's language: in it their help is written; what crosses the border is a `Language`."""

from sim.cli.spoken.commands import (
    Spoken,
    SpokenGroup,
    complaint,
    localised,
    spoken,
    words,
)

__all__ = ["Spoken", "SpokenGroup", "complaint", "localised", "spoken", "words"]
