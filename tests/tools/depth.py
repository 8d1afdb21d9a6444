"""How many cases a test of a property tries: some in the suite, all that are promised in ``make deep``."""

import os

DEEP = bool(os.environ.get("DRYCUT_DEEP"))


def cases(suite: int, deep: int) -> range:
    """Numbers of the cases, which seed them: the first ones in the suite, all in ``make deep``."""
    return range(deep if DEEP else suite)
