"""Settings of a check: `CheckSettings`, those of a settings file near the program under those of the command line."""

from sim.check.settings.model import CheckSettings

__all__ = ["CheckSettings"]
