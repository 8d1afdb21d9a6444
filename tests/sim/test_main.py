"""The command from its first moment: interrupts while it loads, and warnings of libraries."""

import os
import signal
import subprocess
import sys

import pytest
from places import ROOT


def ran(code: str, *options: str) -> subprocess.CompletedProcess[bytes]:
    whole = f"import os, signal, time, warnings\nimport drycut.__main__ as command\n{code}\ncommand.main()\n"
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONWARNINGS"}
    return subprocess.run(
        [sys.executable, *options, "-c", whole, "--version"],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        timeout=60,
        check=False,
    )


@pytest.mark.skipif(sys.platform == "win32", reason="asks for a signal of POSIX")
def test_an_interrupt_while_modules_are_loaded_ends_it_without_a_word() -> None:
    done = ran("command.refuse_strangers = lambda: (os.kill(os.getpid(), signal.SIGINT), time.sleep(20))")
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, b"", b"")


@pytest.mark.skipif(sys.platform == "win32", reason="asks for a signal of POSIX")
def test_an_interrupt_behind_that_is_one_of_python() -> None:
    code = "import sim.cli\nsim.cli.main = lambda: print(signal.getsignal(signal.SIGINT).__name__)"
    assert ran(code).stdout == b"default_int_handler\n"


def test_what_was_ignored_stays_so() -> None:
    code = "signal.signal(signal.SIGINT, signal.SIG_IGN)\nimport sim.cli\n"
    code += "sim.cli.main = lambda: print(signal.getsignal(signal.SIGINT) is signal.SIG_IGN)"
    assert ran(code).stdout == b"True\n"


@pytest.mark.parametrize(("options", "shown"), [((), False), (("-W", "default"), True)])
def test_warnings_of_libraries_are_shown_where_they_are_asked_for(options: tuple[str, ...], shown: bool) -> None:
    code = "import sim.cli\nsim.cli.main = lambda: warnings.warn('overflow encountered', RuntimeWarning)"
    assert (b"overflow encountered" in ran(code, *options).stderr) == shown
