"""The page of ``drycut open``."""

import secrets
from pathlib import Path
from typing import Final

from sim.show.html.environment import rendered

_ASSETS: Final = Path(__file__).with_name("assets")


def open_page() -> tuple[str, str]:
    """The page, and its content security policy: its own script and style alone, and no request but to its server."""
    nonce = secrets.token_urlsafe(16)
    return rendered(_ASSETS, "open.html.j2", nonce=nonce), policy_of(nonce)


def policy_of(nonce: str) -> str:
    """What a page with a nonce may do."""
    return (
        f"default-src 'none'; script-src 'nonce-{nonce}'; style-src 'unsafe-inline'; img-src data:; "
        "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    )
