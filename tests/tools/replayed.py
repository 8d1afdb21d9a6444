"""Replay documents of small runs, and a page that answers questions about one by the replay's own scripts."""

import base64
import io
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image
from places import ROOT
from runs import plain_scenario

from parser.program import parse_program
from sim.base.progress import silent
from sim.run.recording import Recording, recorded
from sim.show.html.environment import joined
from sim.show.replay.document import replay_document

if TYPE_CHECKING:
    from playwright.sync_api import Page

ASSETS = ROOT / "sim" / "show" / "replay" / "assets"


def recording_of(text: str, **changes: object) -> Recording:
    """A run of a program; its steps stay mapped from files that are gone."""
    with recorded(parse_program(text), plain_scenario(**changes), silent) as recording:
        return recording


def document_of(text: str, **changes: object) -> dict[str, Any]:
    return replay_document(recording_of(text, **changes))


def empty_page() -> str:
    """A page with the scripts that read documents, for `replay_of`."""
    scripts = f"const {{ decode }} = {exports('decode')}, {{ modelOf }} = {exports('model')};"
    return f"<!doctype html><html lang=en><title>replay</title><script>{scripts}</script>"


def replay_of(page: "Page", document: dict[str, Any]) -> "Page":
    """The page made of `empty_page`, with the `replay` of a document and the `model` of it in place of those before."""
    page.evaluate("async (doc) => { window.replay = await decode(doc); window.model = modelOf(replay); }", document)
    return page


def exports(module: str) -> str:
    """What a module of the replay's scripts exports, as an expression for a page."""
    return joined(ASSETS / f"{module}.js")


def drawn(page: "Page") -> None:
    """Wait until what was asked for is drawn."""
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def canvas(page: "Page") -> np.ndarray:
    """What the table shows, (height, width, 3) levels."""
    drawn(page)
    picture = page.evaluate("document.getElementById('table').toDataURL()")
    drawing = Image.open(io.BytesIO(base64.b64decode(picture.partition(",")[2])))
    return np.asarray(drawing.convert("RGB"), dtype=int)
