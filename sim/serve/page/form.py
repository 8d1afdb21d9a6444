"""The form of the page as a scenario: its texts are read here, and held to the bounds of every other door."""

from dataclasses import replace
from pathlib import Path

from parser.findings.errors import SettingsError
from parser.findings.messages import Message
from parser.text.encoding import narrow
from parser.units import from_mm
from sim.serve.page.child import PageRequest
from sim.setup.machine.machine import load_machine, machine_names
from sim.setup.part import OFFSET_MM, PASSES, SIDES, DrawingTarget, Offset, OffsetPass
from sim.setup.scenario import THICKNESS_MM, Scenario, load_scenario
from sim.setup.toml.reader import Bound, number
from sim.setup.wire import WIRE_DIAMETER_MM


def scenario_of(request: PageRequest, file: Path) -> Scenario:
    """The scenario of a file with the values of the page; empty texts leave the usual ones.

    SettingsError for a value out of its bounds, or one that is no number.
    """
    scenario = load_scenario(file)
    if request["machine"]:
        if request["machine"] not in machine_names():  # a page names no file of the disk
            raise SettingsError("machine-not-shipped-on-page", name=request["machine"][:40])
        scenario = replace(scenario, machine=load_machine(request["machine"]), machine_by_default=False)
    if request["thickness_mm"]:
        scenario = replace(
            scenario, thickness_mm=number_of(request["thickness_mm"], THICKNESS_MM, Message("name-thickness"))
        )
    if request["wire_mm"]:
        wire_um = from_mm(number_of(request["wire_mm"], WIRE_DIAMETER_MM, Message("name-wire")))
        scenario = replace(scenario, wire=replace(scenario.wire, diameter_um=wire_um))
    if request["drawing_file"]:
        scenario = replace(scenario, drawing=DrawingTarget(Path(request["drawing_file"])))
    return replace(scenario, offset=_offset(request), kerf=True)


def offsets_um(request: PageRequest, bound: Bound) -> tuple[float, ...]:
    """The offsets of the passes; none where nothing is said. SettingsError where one is out of its bounds."""
    words = narrow(request["offset_mm"]).replace(",", " ").split()  # digits and commas of a Chinese keyboard, too
    if words:
        number(len(words), PASSES, Message("name-passes"))
    return tuple(from_mm(number_of(word, bound, Message("name-offset"))) for word in words)


def number_of(text: str, bound: Bound, name: str) -> float:
    """A number that the page says. SettingsError where it is none, or out of its bounds."""
    try:
        value = float(text)
    except ValueError:
        raise SettingsError("text-is-no-number", name=name, found=text[:40]) from None
    return number(value, bound, name)


def _offset(request: PageRequest) -> Offset | None:
    """The offset that the controller is to add, a pass for each number; none where it is left out, or 0 alone."""
    if request["offset_mm"].strip() in {"", "0"}:
        return None
    passes = tuple(OffsetPass(by_um) for by_um in offsets_um(request, OFFSET_MM))
    return Offset(passes, SIDES["left" if request["side"] == "left" else "right"])
