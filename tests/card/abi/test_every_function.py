"""Every function of the library, called in C with the arguments that it has in Python, answers and fills the same."""

from pathlib import Path
from typing import Any, Final

import pytest
from c_library import Made

from controller import GECard
from controller.card.abi.table import Parameter, Prototype, prototypes
from controller.card.core.settings import CardSettings
from controller.card.lookahead import TLookAheadMsg, TLookData

BLOCK: Final = TLookData(1, 17, 0.0, 10.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0, 1, 0)
C_TYPES: Final = {"h": "short", "H": "unsigned short", "l": "long", "L": "unsigned long", "d": "double"}
ARGUMENTS: Final = {
    "plain": {"c": 1, "h": 1, "H": 1, "i": 3, "l": 5, "L": 7, "d": 1.5},
    "odd": {"c": 17, "h": -2, "H": 2, "i": -1, "l": -70_000, "L": 3_000_000_000, "d": -0.125},
}
UNFILLED: Final = "0x5A"
"""Byte of memory that nothing filled."""


def in_python(parameter: Parameter, values: dict[str, Any]) -> Any:
    letter = parameter.letter
    return {"s": "a.txt", "B": BLOCK, "K": None}.get(letter, values.get(letter))


def in_c(parameter: Parameter, values: dict[str, Any]) -> str:
    letter = parameter.letter
    return {"s": '(char *)"a.txt"', "B": "&block", "K": "0"}.get(letter, str(values.get(letter)))


def outs(one: Prototype) -> list[Parameter]:
    return [parameter for parameter in one.parameters if parameter.is_out]


def called_in_c(one: Prototype, values: dict[str, Any]) -> str:
    """A block of C: the call, and a line with the code and all that was filled."""
    declared, printed, given, filled = [], [], [], 0
    for parameter in one.parameters:
        if not parameter.is_out:
            given.append(in_c(parameter, values))
            continue
        name, letter = f"out{filled}", parameter.letter
        filled += 1
        kind = {"P": "double", "M": "TLookAheadMsg"}.get(letter) or C_TYPES[letter]
        size = "[4]" if letter == "P" else ""
        declared.append(f"{kind} {name}{size}; memset(&{name}, {UNFILLED}, sizeof {name});")
        given.append(name if letter == "P" else f"&{name}")
        parts = {"P": [f"{name}[{i}]" for i in range(4)], "M": [f"{name}.{part}" for part in TLookAheadMsg._fields]}
        printed += parts.get(letter, [name])
    shown = "".join(f", (double){part}" for part in printed)
    return (
        f"{{ {' '.join(declared)} GT_Open(65535); int code = {one.name}({', '.join(given)}); "
        f'printf("{one.name} %d{" %.17g" * len(printed)}\\n", code{shown}); }}\n'
    )


def answered(card: GECard, one: Prototype, values: dict[str, Any]) -> str:
    """The same line by the card in Python."""
    card.GT_Open()
    given = [in_python(parameter, values) for parameter in one.parameters if not parameter.is_out]
    answer = getattr(card, one.name)(*given)
    code, *filled = answer if isinstance(answer, tuple) else (answer,)
    flat = [float(part) for value in filled for part in (value if isinstance(value, tuple) else (value,))]
    return " ".join([one.name, str(int(code)), *(f"{part:.17g}" for part in flat)])


@pytest.mark.alike(1)
@pytest.mark.parametrize("arguments", ARGUMENTS)
def test_each_answers_and_fills_as_in_python(library: Made, tmp_path: Path, arguments: str) -> None:
    values = ARGUMENTS[arguments]
    block = ", ".join(map(str, BLOCK))
    calls = "".join(called_in_c(one, values) for one in prototypes())
    source = tmp_path / "every.c"
    source.write_text(f'#include "client.h"\nint main(void) {{ TLookData block = {{{block}}};\n{calls}return 0; }}\n')
    done = library.compile(source, tmp_path / "every")
    assert (done.returncode, done.stderr) == (0, "")
    ran = library.run(tmp_path / "every", tmp_path)
    assert (ran.code, ran.err) == (0, "")
    card = GECard(CardSettings(call_s=1e-3))
    assert ran.out.splitlines() == [answered(card, one, values) for one in prototypes()]
    assert len(ran.out.splitlines()) == 173
