"""The page of ``drycut open``."""

import secrets
from collections.abc import Sequence
from pathlib import Path
from typing import Final

from parser.drawing.model import DEFAULT_GAP_UM
from parser.units import mm
from sim.setup.machine.guides import ANGLE_DEG
from sim.setup.machine.machine import machine_names
from sim.setup.making import DIRECTION_WISHES, LANGUAGES, SIDE_WISHES
from sim.setup.part import DRAWING_UNITS, OFFSET_MM
from sim.setup.scenario import DEFAULT_MACHINE
from sim.setup.settable import FIELDS
from sim.setup.taper import PLANE_MM
from sim.setup.wire import DEFAULT_WIRE
from sim.show.html.environment import rendered
from sim.show.keys import OF_PAGE, actions_of
from sim.show.texts.texts import texts

_ASSETS: Final = Path(__file__).with_name("assets")
_PICTURE: Final = "picture_"
"""Begins the words that say what a picture is."""


def open_page(starts: Sequence[str]) -> tuple[str, str]:
    """The page, and its content security policy: its own script and style alone, and no request but to its server.

    `starts` are the names of what it offers to begin with.
    """
    nonce = secrets.token_urlsafe(16)
    page = rendered(
        _ASSETS,
        "open.html.j2",
        nonce=nonce,
        machines=machine_names(),
        languages=LANGUAGES,
        units=DRAWING_UNITS,
        sides=SIDE_WISHES,
        directions=DIRECTION_WISHES,
        join=f"{mm(DEFAULT_GAP_UM):g}",
        default_machine=DEFAULT_MACHINE,
        fields=FIELDS,
        offset_mm=OFFSET_MM,
        angle_deg=ANGLE_DEG,
        plane_mm=PLANE_MM,
        starts=starts,
        actions=actions_of(OF_PAGE),
        reach=f"{mm(DEFAULT_WIRE.reach_um):g}",
        pictures={
            name.removeprefix(_PICTURE): said._asdict()
            for name, said in texts("common").items()
            if name.startswith(_PICTURE)
        },
    )
    return page, policy_of(nonce)


def policy_of(nonce: str) -> str:
    """What a page with a nonce may do: show files of its runs, and ask its server."""
    return (
        f"default-src 'none'; script-src 'nonce-{nonce}'; style-src 'unsafe-inline'; img-src 'self' data:; "
        "media-src 'self'; frame-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none'; "
        "frame-ancestors 'none'"
    )
