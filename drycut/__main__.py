"""The command: ``drycut``, and ``python -m drycut`` where its script is not on the path."""

import gc
import sys
from typing import Final

from drycut.clash import refuse_strangers

_FEW_LOOKS: Final = (100_000, 10, 10)
"""How seldom Python looks for cycles, which drycut hardly makes: looks took a seventh of a short command's time."""


def main() -> None:
    """Run the command; where another package stands in the place of one of ours, say so and end with 2."""
    gc.set_threshold(*_FEW_LOOKS)
    try:
        refuse_strangers()
    except ImportError as error:
        print(f"drycut: error: {error}", file=sys.stderr)  # our own words are not there to be loaded
        sys.exit(2)
    from sim.cli import main as command  # noqa: PLC0415 - behind the look

    command()


if __name__ == "__main__":
    main()
