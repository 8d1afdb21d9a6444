"""The page of ``drycut open`` in a browser."""

import re
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, ExitStack, contextmanager
from typing import TYPE_CHECKING, NamedTuple
from urllib.parse import urlsplit

from browser import LOCALES, WAIT_MS, Browsers

if TYPE_CHECKING:
    from playwright.sync_api import Page


class Tab:
    """A page of the server, and what went wrong on it."""

    def __init__(self, page: "Page") -> None:
        self.page, self.found, self.asked = page, list[str](), list[str]()
        page.on("console", lambda one: self.found.append(one.text) if one.type in {"error", "warning"} else None)
        page.on("pageerror", lambda error: self.found.append(str(error)))
        page.on("dialog", lambda shown: self.found.append(shown.message))

    def text(self) -> str:
        return self.page.input_value("#text")

    def codes(self) -> list[str]:
        return [text.split("·")[-1].split()[0] for text in self.page.locator("#found .go").all_inner_texts()]

    def waits_for(self, verdict: str) -> None:
        self.page.wait_for_selector(f"#counts.{verdict}")

    def selected(self) -> str:
        return self.page.evaluate("() => { const a = document.activeElement;"
                                  " return a.value.slice(a.selectionStart, a.selectionEnd); }")  # fmt: skip

    def drops(self, name: str, text: str) -> None:
        self.page.evaluate(
            """([name, text]) => {
              const data = new DataTransfer();
              data.items.add(new File([text], name));
              window.dispatchEvent(new DragEvent("drop", { dataTransfer: data, cancelable: true }));
            }""",
            [name, text],
        )


class Window(NamedTuple):
    """What a page is seen in; with `is_golden` every text is in the shipped font, the same on every machine."""

    width: int = 1280
    height: int = 800
    lang: str = "en"
    scheme: str = "light"
    is_golden: bool = False


def tab(browsers: Browsers, address: str, width: int = 1280, lang: str = "en") -> AbstractContextManager[Tab]:
    """A page in a browser that asks nothing but its server; complaints fail the test."""
    return tab_in(browsers, address, Window(width, lang=lang))


@contextmanager
def tab_in(browsers: Browsers, address: str, window: Window) -> Iterator[Tab]:
    """The same in a window of any kind."""
    contexts = browsers.of(window.is_golden)
    settings = {"locale": LOCALES[window.lang], "accept_downloads": True, "color_scheme": window.scheme}
    lent = contexts.lend(settings, window.width, window.height, "http://" + urlsplit(address).netloc)
    with ExitStack() as closing:
        closing.callback(lent.context.close)
        lent.context.set_default_timeout(WAIT_MS)
        shown = Tab(lent.page)
        shown.page.on("request", lambda sent: shown.asked.append(sent.url))
        with shown.page.expect_response("**/first"):  # what is open at the start has come, and would replace other text
            shown.page.goto(address)
        shown.page.wait_for_function("() => document.querySelector('#name').textContent !== ''")
        yield shown
        assert shown.found == []
        assert [url for url in shown.asked if not url.startswith((address, "blob:", "data:"))] == []
        closing.pop_all()
    contexts.take_back(lent)


def places_of(shown: Tab) -> Callable[[float, float], tuple[float, float]]:
    """Where on the page places of the picture lie, mm, by what is read where the pointer is."""
    box = shown.page.locator("#picture").bounding_box()
    assert box
    read = []
    for share in (0.4, 0.6):
        place = box["x"] + share * box["width"], box["y"] + share * box["height"]
        shown.page.mouse.move(*place)
        said = shown.page.inner_text("#reading-cursor")
        read.append((place, [float(each) for each in re.findall(r"-?[\d.]+", said)]))
    (this, at), (other, to) = read
    scale = [(there - here) / (mm - own) for here, there, own, mm in zip(this, other, at, to, strict=True)]
    return lambda x, y: (this[0] + scale[0] * (x - at[0]), this[1] + scale[1] * (y - at[1]))


def planned(page: "Page", said: str = "Plan, not proved") -> None:
    """Wait until the plan of a drawing says something: a process loads, reads and plans, seconds even at rest."""
    page.locator("#drawing-told li", has_text=said).wait_for(timeout=3 * WAIT_MS)
