"""Templates of the pages: one self-contained file each, and whatever a program or a scenario says stands escaped."""

from pathlib import Path
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from sim import __version__
from sim.show.html.bundle import joined
from sim.show.html.script_json import script_json
from sim.show.html.theme import theme_css

_SHARED = Path(__file__).with_name("assets")


def rendered(assets: Path, template: str, **values: Any) -> str:
    """Page of a template in the folder `assets`, which may extend ``base.html.j2`` and import ``words.html.j2``.

    In a template ``{{ inlined("page.css") }}`` is a style sheet of the folder as it stands, ``{{ joined("main.js") }}``
    its module with all that this imports (see `sim.show.html.bundle`), and ``{{ value | script_json }}`` data for a
    script; all else is escaped.
    """
    environment = Environment(
        loader=FileSystemLoader([assets, _SHARED]),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters["script_json"] = script_json
    environment.globals |= {
        "inlined": _Inlined(environment),
        "joined": lambda name: Markup(joined(assets / name)),  # noqa: S704 - as in _Inlined
        "drycut_version": __version__,
        "theme_css": theme_css,
    }
    return environment.get_template(template).render(**values)


class _Inlined:
    """Text of an asset, as it stands."""

    def __init__(self, environment: Environment) -> None:
        self._environment = environment

    def __call__(self, name: str) -> Markup:
        loader = self._environment.loader
        assert loader is not None  # noqa: S101 - given in `rendered`
        text, *_ = loader.get_source(self._environment, name)
        return Markup(text)  # noqa: S704 - a file of this package, never of a user
