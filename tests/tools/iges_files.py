"""IGES files as a CAD writes them: entities with their parameters, in lines of 80 columns."""

from typing import NamedTuple


class Entity(NamedTuple):
    """An entity: type and form, its parameters, and what the directory says of it."""

    kind: int
    values: tuple[object, ...]
    form: int = 0
    transform: int = 0
    status: str = "00000000"
    level: int = 1
    font: int = 1
    color: int = 0


def number_of(at: int) -> int:
    """The number by which others name the entity at an index."""
    return 2 * at + 1


def iges(entities: list[Entity], unit: str = "2,2HMM", delimiters: tuple[str, str] = (",", ";")) -> bytes:
    """A file of entities; `unit` is flag and name, parted by a comma."""
    parts, ends = delimiters
    head = ["1H" + parts, "1H" + ends, "9Ha,b;c.igs", "4Htest", "4Htest", "3H1.0", "32", "38", "6", "308", "15"]
    head += ["4Hpart", "1.0", *unit.split(","), "1", "0.01", "15H20261130.120000", "1.0E-06", "100.0", "2Hme", "2Hus"]
    lines = ["S" + "a part; not, a drawing"]
    lines += ["G" + text for text in _wrapped(parts.join([*head, "11", "0"]) + ends, 72)]
    directory, parameters = list[str](), list[str]()
    for at, each in enumerate(entities):
        record = parts.join([str(each.kind), *map(_text, each.values)]) + ends
        rows = _wrapped(record, 64)
        own = [each.kind, len(parameters) + 1, 0, each.font, each.level, 0, each.transform, 0]
        directory.append("D" + "".join(f"{number:8d}" for number in own) + each.status)
        own = [each.kind, 0, each.color, len(rows), each.form]
        directory.append("D" + "".join(f"{number:8d}" for number in own) + " " * 24 + f"{0:8d}")
        parameters += [f"P{row:64s}{number_of(at):8d}" for row in rows]
    counted: dict[str, int] = {}
    text = []
    for line in [*lines, *directory, *parameters]:
        section = line[0]
        counted[section] = counted.get(section, 0) + 1
        text.append(f"{line[1:]:72s}{section}{counted[section]:7d}")
    ended = "".join(f"{section}{counted.get(section, 0):7d}" for section in "SGDP")
    text.append(f"{ended:72s}T      1")
    return ("\r\n".join(text) + "\r\n").encode("latin-1")


def _text(value: object) -> str:
    return f"{value:.10G}".replace("E", "D") if isinstance(value, float) else str(value)


def _wrapped(text: str, width: int) -> list[str]:
    return [text[at : at + width] for at in range(0, len(text), width)]


def line(x1: float, y1: float, x2: float, y2: float) -> tuple[float, ...]:
    """Parameters of a line."""
    return x1, y1, 0.0, x2, y2, 0.0
