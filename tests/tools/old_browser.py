"""Chromium 86 of 2020, the oldest browser that the pages promise: unpacked from the package that npm has of it."""

import contextlib
import platform
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from browser import WAIT_MS, Browsers
from places import ROOT

if TYPE_CHECKING:
    from playwright.sync_api import Page

PACKED = ROOT / "node_modules" / "chrome-aws-lambda" / "bin" / "chromium.br"
UNPACK = """
const [packed, path] = process.argv.slice(1), fs = require("fs");
fs.writeFileSync(path, require("zlib").brotliDecompressSync(fs.readFileSync(packed)), { mode: 0o755 });
"""
# Not --single-process: with it one start in some 25 hangs once a client connects (of 190 without it, none did).
FLAGS = (
    *("--headless", "--no-sandbox", "--disable-gpu", "--no-zygote", "--hide-scrollbars"),
    *("--window-size=1280,900", "--remote-debugging-port=0", "about:blank"),
)
LISTENS = re.compile(r"^DevTools listening on (ws://\S+)\s", re.MULTILINE)
LONGEST_S = 60.0


def missing() -> str:
    """Why there is no such browser here; empty where there is."""
    if sys.platform != "linux" or platform.machine() != "x86_64":
        return "the old Chromium is for Linux on x86-64"
    if not PACKED.is_file() or not shutil.which("node"):
        return "`make scripts` did not install the old Chromium: there is no npm, or it could not"
    return ""


@contextlib.contextmanager
def old_page(browsers: Browsers, folder: Path) -> Iterator["Page"]:
    """A page of the browser, which is unpacked into a folder; a machine without what it needs skips the test."""
    path, log = folder / "chromium", folder / "log.txt"
    unpack = (shutil.which("node") or "node", "-e", UNPACK, str(PACKED), str(path))
    subprocess.run(unpack, check=True, timeout=LONGEST_S)
    with log.open("wb") as stderr:
        browser = subprocess.Popen([str(path), f"--user-data-dir={folder / 'user'}", *FLAGS], stderr=stderr)
    try:
        page = browsers.connected(_address(browser, log)).contexts[0].pages[0]
        page.set_default_timeout(WAIT_MS)
        yield page
    finally:
        browser.kill()
        browser.wait()


def _address(browser: "subprocess.Popen[bytes]", log: Path) -> str:
    """Where it listens, which it tells once it has started."""
    until = time.monotonic() + LONGEST_S
    while not (told := LISTENS.search(log.read_text("utf-8", "replace"))):
        if browser.poll() is not None:
            pytest.skip("the old Chromium does not start here: a library that it needs is missing")
        assert time.monotonic() < until
        time.sleep(0.02)
    return told[1]
