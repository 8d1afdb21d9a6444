"""The paints of the pictures as properties of a style sheet: pages and pictures show one thing in one colour."""

from markupsafe import Markup

from sim.show.draw.paints import DARK, LIGHT, Theme


def theme_css() -> Markup:
    """Every paint as ``--name``: light, and dark on a screen that is set so."""
    dark = f"@media screen and (prefers-color-scheme: dark) {{ {_root(DARK)} }}"
    return Markup(f"{_root(LIGHT)}\n{dark}")  # noqa: S704 - names and numbers of this package


def _root(theme: Theme) -> str:
    paints = " ".join("--{}: #{:02x}{:02x}{:02x};".format(paint.value, *colour) for paint, colour in theme.items())
    return f":root {{ {paints} }}"
