"""What fails in the card's library never looks like success: -1, and 0 in what was to be filled."""

from pathlib import Path

import pytest
from c_library import Made

CLIENT = """#include "client.h"
int main(void)
{
    unsigned short status = 0xDEAD;
    double place[5] = {7, 7, 7, 7, 7};
    long at = -1;
    printf("%d ", GT_GetCrdSts(&status));
    printf("%d ", GT_GetPrfPnt(place));
    printf("%d ", GT_GetAtlPos(1, &at));
    printf("%d | %x %g %g %g %ld", GT_LnXY(1, 2), status, place[0], place[3], place[4], at);
    return 0;
}
"""
FAILED = "-1 -1 -1 -1 | 0 0 0 7 0"


@pytest.mark.parametrize(
    ("asked", "says"),
    [
        ({}, ""),  # not open yet
        ({"DRYCUT_CARD": "missing.toml"}, "missing.toml"),
        ({"DRYCUT_CALL_S": "0"}, "call_s"),
        ({"DRYCUT_CALL_S": "soon"}, "DRYCUT_CALL_S is a number"),
        ({"DRYCUT_CLOCK": "-1"}, "DRYCUT_CLOCK"),
        ({"DRYCUT_CARD_LOG": "missing/card.log"}, "missing/card.log: cannot be written"),
        ({"DRYCUT_CARD_LOG": "/dev/full"}, "No space left"),
    ],
    ids=str,
)
def test_calls_that_cannot_be_made(library: Made, tmp_path: Path, asked: dict[str, str], says: str) -> None:
    (tmp_path / "client.c").write_text(CLIENT, "utf-8")
    assert library.compile(tmp_path / "client.c", tmp_path / "client").returncode == 0
    ran = library.run(tmp_path / "client", tmp_path, **asked)
    assert ran.out == FAILED
    assert says in ran.err
    assert ran.err.count("\n") == (1 if says else 0)
