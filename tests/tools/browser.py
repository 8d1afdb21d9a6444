"""Pages in Debian's chromium, opened as from a file manager, offline and watched.

A test takes the fixture `open_page`. What a page complains of, and what it asks for beside itself, fails the test when
it ends.
"""

import os
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol
from xml.sax.saxutils import escape

import chromium
import pytest
from browser_contexts import Contexts, Lent

from sim.show.draw import style

if TYPE_CHECKING:
    from playwright.sync_api import Browser, BrowserContext, ConsoleMessage, Dialog, Page, Playwright, Request

    Heard = dict[str, Callable[[Any], None]]

FLAGS = (
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-gpu",
    "--disable-lcd-text",
    "--disable-quic",
    "--disable-sync",
    "--font-render-hinting=none",
    "--no-first-run",
)
WAIT_MS = 15_000
LOCALES = {"en": "en-US", "zh": "zh-CN"}
INSIDE = ("about:", "blob:", "data:")

FONTS = """\
<?xml version="1.0"?>
<!DOCTYPE fontconfig SYSTEM "fonts.dtd">
<fontconfig>{system}<dir>{shipped}</dir><cachedir>{cache}</cachedir></fontconfig>
"""
SYSTEM_FONTS = '<include ignore_missing="yes">/etc/fonts/fonts.conf</include>'


class Watched(NamedTuple):
    """A page and what went wrong on it so far."""

    page: "Page"
    found: list[str]
    heard: "Heard"

    def problems(self) -> list[str]:
        """Errors and warnings of the console, errors of scripts, dialogs, windows, and requests beside the page."""
        if not self.page.is_closed():
            self.page.wait_for_function("() => true")  # has a time limit, and what is under way is told before
        return list(self.found)

    def leave(self, context: "BrowserContext") -> None:
        """Write down no more of what a context tells."""
        for event, handler in self.heard.items():
            context.remove_listener(event, handler)


class OpenPage(Protocol):
    """What the fixture `open_page` gives."""

    def __call__(
        self,
        page: Path | str,
        width: int = 1280,
        height: int = 800,
        *,
        lang: str = "en",
        dark: bool = False,
        shipped_font: bool = False,
        **context: object,
    ) -> Watched:
        """A page from its file or its text, in a browser of this language; the rest is for `Browser.new_context`.

        With `shipped_font` every text, on a canvas too, is in the font of the pictures, the same on every machine.
        """


class Browsers:
    """Chromium with the fonts of the machine, and chromium with the shipped font alone: each started when asked for."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._closing = ExitStack()
        self._playwright: Playwright | None = None
        self._running: dict[bool, Contexts] = {}

    def of(self, shipped_font: bool) -> Contexts:
        """The browser with these fonts; a test without any browser is skipped here, or fails in CI."""
        if shipped_font not in self._running:
            self._running[shipped_font] = Contexts(self._launch(shipped_font))
        return self._running[shipped_font]

    def connected(self, address: str) -> "Browser":
        """A browser that listens on an address of this machine."""
        return self._started().chromium.connect_over_cdp(address)

    def close(self) -> None:
        """End the browsers."""
        self._closing.close()

    def _launch(self, shipped_font: bool) -> "Browser":
        path = chromium.executable() or chromium.give_up()
        root = hasattr(os, "geteuid") and os.geteuid() == 0
        return self._started().chromium.launch(
            executable_path=path,
            args=[*FLAGS, *(["--no-sandbox"] if root else [])],
            env={**os.environ, "FONTCONFIG_FILE": str(self._fonts(shipped_font))},
        )

    def _started(self) -> "Playwright":
        if self._playwright is None:
            from playwright.sync_api import sync_playwright

            self._playwright = self._closing.enter_context(sync_playwright())
        return self._playwright

    def _fonts(self, shipped_font: bool) -> Path:
        """Settings of fontconfig; with the machine's fonts too, the shipped one lends what they lack, as Chinese."""
        path = self._folder / f"fonts-{shipped_font}.conf"
        system = "" if shipped_font else SYSTEM_FONTS
        shipped, cache = (escape(str(folder)) for folder in (Path(style.FONT).parent, self._folder / "cache"))
        path.write_text(FONTS.format(system=system, shipped=shipped, cache=cache), "utf-8")
        return path


class Pages:
    """The pages of one test: each in a context that no other has meanwhile, as if nobody had opened one before."""

    def __init__(self, browser: Callable[[bool], Contexts], folder: Path) -> None:
        self._browser, self._folder = browser, folder
        self._opened: list[tuple[Contexts, Lent, Watched]] = []

    def open(
        self,
        page: Path | str,
        width: int = 1280,
        height: int = 800,
        *,
        lang: str = "en",
        dark: bool = False,
        shipped_font: bool = False,
        **context: object,
    ) -> Watched:
        """`OpenPage`."""
        settings = {
            "locale": LOCALES[lang],
            "color_scheme": "dark" if dark else "light",
            "offline": True,
            "timezone_id": "UTC",
        }
        contexts = self._browser(shipped_font)
        lent = contexts.lend({**settings, **context}, width, height)
        watched = watch(lent.context, lent.page)
        self._opened.append((contexts, lent, watched))
        watched.page.goto(self._file(page).as_uri())
        return watched

    def close(self) -> None:
        """Close the pages, and complain of what was wrong on any."""
        with ExitStack() as closing:
            for _, lent, _ in self._opened:
                closing.callback(lent.context.close)
            problems = [problem for _, _, watched in self._opened for problem in watched.problems()]
            if not problems:
                closing.pop_all()
        if problems:
            pytest.fail("\n".join(problems), pytrace=False)
        for contexts, lent, watched in self._opened:
            watched.leave(lent.context)
            contexts.take_back(lent)

    def _file(self, page: Path | str) -> Path:
        if isinstance(page, Path):
            return page.resolve()
        path = self._folder / f"page-{len(self._opened)}.html"
        path.write_text(page, "utf-8")
        return path


def watch(context: "BrowserContext", page: "Page") -> Watched:
    """A page of a context whose complaints, and those of all that it opens, are written down."""
    context.set_default_timeout(WAIT_MS)
    found: list[str] = []

    def console(message: "ConsoleMessage") -> None:
        if message.type in {"error", "warning", "assert"}:
            found.append(f"console {message.type}: {message.text}")

    def request(sent: "Request") -> None:
        own = sent.url.startswith("file:") and sent.is_navigation_request()
        if not own and not sent.url.startswith(INSIDE):
            found.append(f"request: {sent.url}")

    def dialog(shown: "Dialog") -> None:
        found.append(f"dialog: {shown.message}")
        shown.dismiss()

    heard: Heard = {
        "console": console,
        "weberror": lambda error: found.append(f"script: {error.error}"),
        "request": request,
        "dialog": dialog,
        "page": lambda other: found.append(f"window: {other.url}"),
    }
    for event, handler in heard.items():
        context.on(event, handler)
    return Watched(page, found, heard)


@pytest.fixture(scope="session")
def browsers(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Browsers]:
    """The browsers of a session of tests, none of them running yet."""
    running = Browsers(tmp_path_factory.mktemp("browser"))
    yield running
    running.close()


@pytest.fixture
def open_page(browsers: Browsers, tmp_path: Path) -> Iterator[OpenPage]:
    """Opens a page; its problems fail the test at the end."""
    pages = Pages(browsers.of, tmp_path)
    yield pages.open
    pages.close()
