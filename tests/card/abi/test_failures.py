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


@pytest.mark.alike(3)
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


FORKING = """#include <sys/wait.h>

#include "client.h"
int main(void)
{
    unsigned short status = 0xDEAD;
    int code, child, ended;
    printf("%d ", GT_Open(65535));
    fflush(stdout);
    child = fork();
    code = GT_GetCrdSts(&status);
    if (!child)
        _exit(code == -1 && status == 0 ? 42 : 1);
    waitpid(child, &ended, 0);
    printf("%d %x, child %d", code, status, WEXITSTATUS(ended));
    return GT_Close();
}
"""


def test_the_child_of_a_fork_has_no_card_and_its_parent_keeps_it(library: Made, tmp_path: Path) -> None:
    (tmp_path / "client.c").write_text(FORKING, "utf-8")
    assert library.compile(tmp_path / "client.c", tmp_path / "client").returncode == 0
    ran = library.run(tmp_path / "client", tmp_path)
    assert (ran.code, ran.out) == (0, "0 0 2001, child 42")


FAILING = """#include <sys/resource.h>

#include "client.h"
int main(void)
{
    struct rlimit most = {2000, 2000};
    unsigned short status;
    int good = 0, code;
    printf("%d ", GT_Open(65535));
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &most);
    do {
        status = 0xDEAD;
        code = GT_GetCrdSts(&status);
    } while (!code && ++good < 1000);
    printf("%d %d %x", good > 10 && good < 100, code, status);
    return 0;
}
"""


def test_an_error_of_python_in_the_middle_of_a_call_is_no_success(library: Made, tmp_path: Path) -> None:
    """The log may not grow any more: writing a call to it fails."""
    (tmp_path / "client.c").write_text(FAILING.replace("#include", "#include <signal.h>\n#include", 1), "utf-8")
    assert library.compile(tmp_path / "client.c", tmp_path / "client").returncode == 0
    ran = library.run(tmp_path / "client", tmp_path)
    assert (ran.code, ran.out) == (0, "0 1 -1 0")
    assert "GT_GetCrdSts cannot be answered: OSError" in ran.err
