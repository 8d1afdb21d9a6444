"""The licences of all packages that drycut brings, ``docs/licences.md``, from their metadata: `make pages`."""

import re
from collections.abc import Iterator
from importlib import metadata
from pathlib import Path

from packaging.requirements import Requirement

PAGE = Path(__file__).parents[2] / "docs" / "licences.md"
HEAD = """# Licences of what drycut brings

drycut is under the MIT licence, its font under the SIL Open Font License 1.1. It brings these packages, each by the
extra that needs it; `core` stands for what is always there. The licences are those that the packages state themselves.
pygame-ce is under the LGPL: it is a package of its own, which users may replace. The wheel of imageio-ffmpeg carries
FFmpeg, a program with a licence of its own. `make release` writes all packages with their versions into an SBOM.

| package | licence | extras |
|---|---|---|
"""
_EXTRAS = ("core", "run", "drawing", "open", "lsp", "film", "cluster")
_CLASSIFIER = "License :: OSI Approved :: "
_LONGEST = 60


def page() -> str:
    """The page as the packages that are installed here give it."""
    extras: dict[str, list[str]] = {}
    for extra in _EXTRAS:
        for name in sorted(closure(extra)):
            extras.setdefault(name, []).append(extra)
    rows = [f"| {name} | {licence(name)} | {', '.join(shown(of))} |" for name, of in sorted(extras.items())]
    return HEAD + "\n".join(rows) + "\n"


def shown(extras: list[str]) -> list[str]:
    """Extras that bring a package, without those that bring it by another one."""
    by = {"run": {"drawing", "open", "film", "cluster"}, "drawing": {"open"}, "core": set(_EXTRAS[1:])}
    implied = set().union(*(by.get(extra, set()) for extra in extras))
    return [extra for extra in extras if extra not in implied]


def closure(extra: str) -> set[str]:
    """Packages that an extra of drycut brings, with all that they need here."""
    found: set[str] = set()
    waiting = [("drycut", "" if extra == "core" else extra)]
    seen = set(waiting)
    while waiting:
        for name, of in needed(*waiting.pop()):
            if name != "drycut":
                found.add(name)
            if (name, of) not in seen:
                seen.add((name, of))
                waiting.append((name, of))
    return found


def needed(name: str, extra: str) -> Iterator[tuple[str, str]]:
    """What a package needs for an extra of it, with the extras of what it needs; other systems' aside."""
    for text in metadata.requires(name) or []:
        of = Requirement(text)
        is_of_extra = of.marker is not None and "extra" in str(of.marker)
        if is_of_extra == bool(extra) and (of.marker is None or of.marker.evaluate({"extra": extra})):
            yield from ((normal(of.name), theirs) for theirs in ("", *sorted(of.extras)))


def normal(name: str) -> str:
    """The name of a package as indices have it."""
    return re.sub(r"[-_.]+", "-", name).lower()


def licence(name: str) -> str:
    """What a package states of its licence."""
    of = metadata.metadata(name)
    stated = of.get("License-Expression") or ""
    listed = [value.removeprefix(_CLASSIFIER) for value in of.get_all("Classifier") or [] if _CLASSIFIER in value]
    first = (of.get("License") or "").strip().split("\n")[0]
    return stated or ", ".join(listed) or (first if 0 < len(first) <= _LONGEST else "")


if __name__ == "__main__":
    PAGE.write_text(page(), "utf-8", newline="\n")
