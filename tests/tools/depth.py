"""How many cases a test of a property tries: some in the suite, all that are promised in ``make deep``."""

import os

DEEP = bool(os.environ.get("DRYCUT_DEEP"))


def cases(suite: int, deep: int) -> range:
    """Numbers of the cases, which seed them: the first ones in the suite, all in ``make deep``."""
    return range(deep if DEEP else suite)


def examples(deep: int = 100) -> int:
    """How many examples a property is tried on that `hypothesis` makes: a fifth of them in the suite."""
    return deep if DEEP else max(deep // 5, 5)


def spread(most: int, number: int) -> set[int]:
    """Which of so many cases stand for all of them: `most`, the first and the last among them."""
    return {round(at * (number - 1) / max(most - 1, 1)) for at in range(most)}
