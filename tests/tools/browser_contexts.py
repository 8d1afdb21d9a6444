"""Contexts of a browser, lent to one test after another.

Each keeps a blank page open: beside it, a page takes two thirds of the time of the first one in a new context.
"""

from collections import defaultdict
from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from playwright.sync_api import Browser, BrowserContext, Page

FILES = "file://"
"""The origin of all pages that are opened from files, which share what they store."""

_MOST = 4
"""Idle contexts that are kept, as each has a process."""


class Lent(NamedTuple):
    """A context with an empty page, and the settings that it was asked for with."""

    context: "BrowserContext"
    page: "Page"
    kind: str


class Contexts:
    """Contexts of a browser; each is lent to one at a time."""

    def __init__(self, browser: "Browser") -> None:
        self._browser = browser
        self._idle: dict[str, list[BrowserContext]] = defaultdict(list)

    def lend(self, settings: Mapping[str, object], width: int, height: int, origin: str = FILES) -> Lent:
        """A context with an empty page of a size, px; nothing is left there of what pages of the origin stored."""
        kind = repr(sorted(settings.items()))
        size = {"width": width, "height": height}
        if not self._idle[kind]:
            context = self._browser.new_context(**settings, viewport=size)
            return Lent(context, context.new_page(), kind)
        context = self._idle[kind].pop()
        page = context.new_page()
        page.set_viewport_size(size)
        context.clear_cookies()
        asked = context.new_cdp_session(page)
        asked.send("Storage.clearDataForOrigin", {"origin": origin, "storageTypes": "all"})
        asked.detach()
        return Lent(context, page, kind)

    def take_back(self, lent: Lent) -> None:
        """Close its pages, and keep it for who asks next; only one whose pages were sound comes back."""
        blank, *others = lent.context.pages
        for page in others:
            page.close()
        blank.goto("about:blank")
        self._idle[lent.kind].append(lent.context)
        if sum(map(len, self._idle.values())) > _MOST:
            oldest = next(kind for kind, idle in self._idle.items() if idle)
            self._idle[oldest].pop(0).close()
