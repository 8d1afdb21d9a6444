"""Chromium for the tests of pages: where it is and how it gets here; ``make test`` runs this as a step."""

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from typing import NoReturn

import pytest

NAMES = (
    "chromium-headless-shell",  # takes a quarter less time than Chromium with its windows
    "chromium",
    "chromium-browser",
    "google-chrome",
    "google-chrome-stable",
    "/Applications/Chromium.app/Contents/MacOS/Chromium",
    "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
)
HOW_TO = """\
neither Chromium nor Chrome was found, which the tests of pages need:
  Debian: apt-get install chromium-headless-shell
  Ubuntu: apt-get install ./google-chrome-stable_current_amd64.deb (the snap of Chromium cannot read the tests' folders)
  Fedora: dnf install chromium
  Arch:   pacman -S chromium
  macOS:  brew install --cask google-chrome"""
UPDATE = ("apt-get", "update", "-q")
INSTALL = ("apt-get", "install", "-y", "-q", "--no-install-recommends")


def executable() -> str | None:
    """Path of the browser, None where there is none."""
    return next(filter(None, map(shutil.which, NAMES)), None)


def needed() -> bool:
    """Whether nothing may be skipped: CI says so by its variable of that name."""
    return bool(os.environ.get("CI"))


def give_up() -> NoReturn:
    """Skip the test that needs a browser, or fail it where nothing may be skipped."""
    pytest.fail(HOW_TO, pytrace=False) if needed() else pytest.skip(HOW_TO)


def may_install() -> bool:
    """Whether Debian's own package can be installed without asking anyone."""
    return hasattr(os, "geteuid") and os.geteuid() == 0 and shutil.which("apt-get") is not None


def install() -> None:
    """Debian's package, quietly; a failure is told by `executable` finding nothing afterwards."""
    for command in (UPDATE, *((*INSTALL, name) for name in NAMES[:2])):
        if executable() is None:
            subprocess.run(command, check=False, env={**os.environ, "DEBIAN_FRONTEND": "noninteractive"})


def make_ready(installer: Callable[[], None] = install) -> int:
    """Install the browser where it is missing and that can be done; exit code of the step."""
    if executable() is None and may_install():
        print("installing chromium for the tests of pages", file=sys.stderr)
        installer()
    if executable():
        return 0
    print(HOW_TO, "" if needed() else "They are skipped.", sep="\n", file=sys.stderr)
    return int(needed())


if __name__ == "__main__":
    sys.exit(make_ready())
