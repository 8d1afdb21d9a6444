"""The command: ``drycut``, and ``python -m drycut`` where its script is not on the path."""

import gc
import signal
import sys
import warnings
from typing import Final

from drycut.clash import refuse_strangers

_FEW_LOOKS: Final = (100_000, 10, 10)
"""How seldom Python looks for cycles, which drycut hardly makes: looks took a seventh of a short command's time."""


def main() -> None:
    """Run the command; where another package stands in the place of one of ours, say so and end with 2.

    While modules are loaded an interrupt ends the process at once: there is nothing to clear up, and a traceback would
    tell of them. Warnings of libraries are for those who make programs: they are shown where ``-W`` asks for them.
    """
    gc.set_threshold(*_FEW_LOOKS)
    if not sys.warnoptions:
        warnings.simplefilter("ignore")
    interrupted = signal.getsignal(signal.SIGINT)
    if interrupted is signal.default_int_handler:  # else it is ignored, as behind nohup
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    try:
        refuse_strangers()
    except ImportError as error:
        print(f"drycut: error: {error}", file=sys.stderr)  # our own words are not there to be loaded
        sys.exit(2)
    from sim.cli import main as command  # noqa: PLC0415 - behind the look

    signal.signal(signal.SIGINT, interrupted)
    command()


if __name__ == "__main__":
    main()
