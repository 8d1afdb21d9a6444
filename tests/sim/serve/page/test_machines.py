"""A machine file that comes to the page: chosen in the form, and the machine of checks, runs and plans from then on."""

import json
import re
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from opened_page import OpenedPage, opened_page
from places import ROOT

from parser.findings.errors import SettingsError
from sim.serve.page.drawings import PLAN_KEYS
from sim.serve.page.machines import Machines, machine_of
from sim.serve.page.runs import KEYS

SHIPPED = (ROOT / "sim" / "setup" / "machine" / "dk7740.toml").read_text("utf-8")
OWN = re.sub(r"(?m)^name_zh = .*\n", "", re.sub(r"(?m)^name = .*$", 'name = "the old one"', SHIPPED))
NARROW = re.sub(r"(?m)^travel_x_mm = \S+", "travel_x_mm = 100.0", OWN)
LONG = "B150000B0B150000GXL1\nB0B90000B90000GYL2\nB150000B0B150000GXL3\nB0B90000B90000GYL4\nDD\n"
TECHNOLOGY = """
[technology]
name = "wire 0.18"
[[cut]]
material = "Cr12"
wire_mm = 0.18
height_mm = 40
gap_um = 15
[[cut]]
material = "copper"
wire_mm = 0.18
height_mm = 40
gap_um = 22
"""
SMALL = "B300B0B300GXL1\nB0B300B300GYL2\nB300B0B300GXL3\nB0B300B300GYL4\nDD\n"


@pytest.fixture(name="served", scope="module")
def served_page() -> Iterator[OpenedPage]:
    with opened_page() as served:
        yield served


def came(served: OpenedPage, text: str, name: str = "old.toml") -> Any:
    return json.loads(served.ask(f"read?name={name}", text).body)


def checked(served: OpenedPage, machine: str) -> Any:
    told = {"name": "part.3b", "text": LONG, "number": "", "machine": machine, "thickness_mm": ""}
    return json.loads(served.ask("check", json.dumps(told)).body)


def ran(served: OpenedPage, machine: str, technology: str = "") -> Any:
    told = dict.fromkeys(KEYS, "") | {"machine": machine, "technology": technology}
    told |= {"name": "a.3b", "text": SMALL, "number": "", "drawing": ""}
    assert served.ask("run", json.dumps(told)).status == 200
    for _ in range(1200):
        state = json.loads(served.ask("progress").body)
        if state["state"] != "running":
            return state
        time.sleep(0.05)
    raise AssertionError(state)


def test_a_technology_that_came_is_offered_by_its_materials_and_cuts_the_kerf_of_the_run(served: OpenedPage) -> None:
    offered = came(served, TECHNOLOGY, "wire.toml")["technologies"]
    assert [each["title"]["en"] for each in offered] == ["wire 0.18: Cr12", "wire 0.18: copper"]
    for of, gap_um in zip(offered, (15.0, 22.0), strict=True):
        state = ran(served, "", of["name"])
        report = json.loads(served.ask(f"run/{state['run']}/report.json", method="GET").body)
        assert report["technology"]["material"] == of["title"]["en"].partition(": ")[2]
        assert report["wire"]["spark_gap_um"] == gap_um
    assert ran(served, "", "../x/Cr12")["state"] != "done"
    assert ran(served, "", offered[0]["name"].partition("/")[0] + "/brass")["state"] != "done"


def test_a_technology_with_a_fault_says_why_by_the_name_of_its_file(served: OpenedPage) -> None:
    why = came(served, TECHNOLOGY.replace("gap_um = 22", ""), "wire.toml")["why"]
    for language in ("en", "zh"):
        assert why[language].startswith("wire.toml")
        assert "gap_um" in why[language]
        assert "technology-" not in why[language]


def test_a_machine_that_came_is_that_of_check_and_run(served: OpenedPage) -> None:
    taken = came(served, NARROW)
    assert taken["machine"]["title"] == {"en": "the old one", "zh": "the old one"}
    name = taken["machine"]["name"]
    own, usual = checked(served, name), checked(served, "")
    assert own["machine"]["en"] == "the old one"
    assert "the old one" in own["size"]["time"]["en"]
    assert {each["code"] for each in own["findings"]} > {each["code"] for each in usual["findings"]}, "150 mm leave it"
    assert came(served, OWN)["machine"]["name"] != name, "each has a name of its own"
    assert ran(served, name)["machine"]["en"] == "the old one"


def test_a_plan_is_for_the_machine_that_came(served: OpenedPage, tmp_path: Path) -> None:
    drawing = ROOT / "scenarios" / "plate" / "drawing.dxf"
    number = json.loads(served.ask("read?name=a.dxf", drawing.read_bytes()).body)["drawing"]
    laid = json.dumps({"turn_rad": 0.0, "shift_um": [0.0, 0.0], "mirror": False})
    told = {**dict.fromkeys(PLAN_KEYS, ""), "language": "3b", "placement": laid, "drawing": number}
    for machine, is_one in ((came(served, OWN)["machine"]["name"], True), ("own-77", False)):
        plan = json.loads(served.ask("plan", json.dumps({**told, "machine": machine})).body)
        assert ("figures" in plan) is is_one


def test_what_is_no_machine_says_why_by_the_name_of_its_file(served: OpenedPage) -> None:
    deep = "x = " + "[" * 5_000
    broken = (("[technology]\nnam = 3", "nam"), (deep, ""))
    for text, said in (("nonsense", "TOML"), *broken, (OWN.replace("drive_damping_ratio", "ratio"), "ratio")):
        why = came(served, text, "old%20one.toml")["why"]
        for language in ("en", "zh"):
            assert "old one.toml" in why[language]
            assert said in why[language]
            assert "own-" not in why[language]
            assert "machines" not in why[language]


def test_a_name_leads_to_no_other_file_of_the_disk(tmp_path: Path) -> None:
    (tmp_path / "other.toml").write_text(OWN)
    machines = Machines(tmp_path)
    name = machines.keep(OWN.encode())
    assert machine_of(name, machines.folder).name == "the old one"
    assert machine_of("dk7740", None).name != "the old one"
    for other in ("../other", "other", "own-1", "own-0/../own-0", str(tmp_path / "other"), "own-0.toml", ""):
        with pytest.raises(SettingsError):
            machine_of(other, machines.folder)
    with pytest.raises(SettingsError):
        machine_of(name, None)
