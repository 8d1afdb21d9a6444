"""Names and texts of files, hostile ones, in every command: no terminal and no build server obeys a line of it."""

import json
import os
import re
import shutil
import xml.etree.ElementTree as ET
from importlib import resources
from pathlib import Path
from subprocess import CompletedProcess

import pytest
from checking import WRONG_AXIS
from command import run_inside
from places import SCENARIOS

pytestmark = pytest.mark.skipif(os.name == "nt", reason="names of files cannot hold these there")

HOSTILE = [
    "\x1b[31mred\x1b]8;;http://x\x07link\r\u202eb3.trap\u2066",
    "##vso[task.setvariable variable=x]y ##[error]z ##teamcity[message text='a']",
    "::error file=a,line=1::b",
    "a\n::set-output name=b::c\n  ##[group]d\nverdict: pass",
    "a \u2028\x85\x9b2J ::warning ::e section_start:1:f\udc80",
]
IDS = ["terminal", "azure", "github", "lines", "others"]
FORMATS = ("text", "concise", "json", "sarif", "junit", "github", "gitlab")
LAYER = "##vso[task.complete]\u202e::error ::x"


def obeyed(text: str, own: str = "") -> list[str]:
    """Lines that a terminal or a build server would obey, but for commands that begin with `own`."""
    harmful = re.compile(
        r"##\[|##vso\[|##teamcity\[|^\s*::|::(error|warning|set-output)( [^:]*)?::|section_\w+:\d"
        "|[\x00-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ud800-\udfff]"
    )
    return [line for line in text.split("\n") if harmful.search(_data(line, own))]


def _data(line: str, own: str) -> str:
    return line.removeprefix("::") if own and re.match(own, line) else line


def told(done: CompletedProcess[bytes], own: str = "") -> str:
    """What a command printed, after a look at each line of it."""
    out, err = done.stdout.decode(), done.stderr.decode()
    assert obeyed(out, own) == obeyed(err) == []
    return out + err


@pytest.mark.alike(1)
@pytest.mark.parametrize("text", HOSTILE, ids=IDS)
def test_findings_of_hostile_files_in_every_format(tmp_path: Path, text: str) -> None:
    name = f"{text.replace('/', ':')}.3b"
    folder = tmp_path / text.replace("/", ":")
    folder.mkdir()
    program = f"{WRONG_AXIS}// {text}\nN7: {text} B1B\n"
    (folder / name).write_bytes(program.encode("utf-8", "surrogateescape"))
    for form in FORMATS:
        done = run_inside("check", folder.name, "--format", form, "--statistics", cwd=tmp_path)
        assert done.returncode == 1, done.stderr
        assert told(done, own=r"::(error|warning|notice) file=" if form == "github" else "")
        shown = done.stdout.decode()
        kept = f"{folder.name}/{name}".encode("utf-8", "replace").decode().replace("\udc80", "?")
        if form == "json":
            assert json.loads(shown)["files"][0]["name"].replace("\ufffd", "?") == kept
        elif form == "junit":
            ET.fromstring(shown)  # noqa: S314 - written by the code under test
    for options in (["--diff"], ["--fix"], ["--write-baseline", f"{folder.name}/{text[:9]}.json".replace("\n", "")]):
        told(run_inside("check", folder.name, *options, cwd=tmp_path))


@pytest.mark.parametrize("text", HOSTILE, ids=IDS)
def test_bad_use_quotes_what_was_typed(tmp_path: Path, text: str) -> None:
    for arguments in (
        *((text,), ("check", text), ("check", "x", f"--{text}"), ("check", "x", "--format", text), ("explain", text)),
        *(("check", "x", "--select", text), ("check", "x", "--machine", text), ("check", "x", "--config", text)),
        *(("run", text), ("run", "x", "--thickness", text), ("run", "x", "--side", text), ("compare", "x", text)),
        *(
            ("ballbar", "--machine", text),
            ("ballbar", "-o", f"{text}.jpg"),
            ("draw", "x", "-o", "a", "--picture", text),
        ),
        *(("draw", "x", "-o", f"{text}.bmp"), ("replay", "x", "-o", f"{text}.avi"), ("replay", "x", "--size", text)),
        *(("card", "replay", text), ("card", text)),
    ):
        done = run_inside(*arguments, cwd=tmp_path)
        assert done.returncode == 2, (arguments, done)
        assert told(done)
        assert done.stdout or len(done.stderr.decode().split("\n")) == 2, arguments


@pytest.mark.parametrize("text", HOSTILE[:4], ids=IDS[:4])
def test_keys_and_values_of_settings(tmp_path: Path, text: str) -> None:
    (tmp_path / "part.3b").write_text("B500B0B500GXL1 DD")
    key = json.dumps(text)
    for name, content in {
        "drycut.toml": f"{key} = 1\n",
        "scenario.toml": f'program = "part.3b"\n[expect]\n{key} = 1\n',
        "machine.toml": f"{key} = 1\n",
        "card.log": f"{text}\n",
    }.items():
        (tmp_path / name).write_text(content, "utf-8", newline="\n")
    (tmp_path / "none").mkdir()
    for arguments in (
        *(("check", "part.3b"), ("run", "part.3b", "--machine", "machine.toml"), ("card", "replay", "card.log")),
        *(("ballbar", "--machine", "machine.toml"), ("run", ".")),
    ):
        done = run_inside(*arguments, cwd=tmp_path)
        assert done.returncode == (1 if arguments == ("run", ".") else 2), (arguments, done)
        assert told(done)


def test_a_run_and_a_comparison_with_hostile_machine_title_layer_and_folder(tmp_path: Path) -> None:
    folder = tmp_path / HOSTILE[3].replace("/", ":")
    shutil.copytree(SCENARIOS / "punch", folder)
    shipped = (resources.files("sim.setup.machine") / "dk7740.toml").read_text("utf-8")
    machine = shipped.replace('"DK7740 class, stepper drives"', json.dumps(HOSTILE[0] + HOSTILE[1] + HOSTILE[2]))
    assert machine != shipped
    (folder / "mine.toml").write_text(machine, "utf-8")
    scenario = folder / "scenario.toml"
    told_before = re.sub("(?m)^title = .*\n", "", scenario.read_text("utf-8"))
    scenario.write_text(f"title = {json.dumps(HOSTILE[1] + HOSTILE[0])}\n{told_before}", "utf-8")
    drawing = folder / "drawing.dxf"
    written = LAYER.replace("\u202e", r"\\U+202E")  # as DXF writes what its code page lacks
    drawing.write_text(re.sub(r"(?m)^(\s*8\n)\S+$", rf"\g<1>{written}", drawing.read_text("utf-8")), "utf-8")
    for options, codes in ((["--layer", LAYER], {0, 1}), (["--layer", "none"], {2})):
        done = run_inside("compare", folder.name, *options, cwd=tmp_path)
        assert done.returncode in codes, done
        assert told(done)
    (folder / "program.3b").write_text(f"B500B0B500GXL1// {HOSTILE[1]}\nB5B\nDD")
    scenario.write_text(f"title = {json.dumps(HOSTILE[1] + HOSTILE[0])}\n", "utf-8")
    for options in ([], ["--json"]):
        done = run_inside("run", folder.name, "--machine", folder / "mine.toml", *options, cwd=tmp_path)
        assert done.returncode == 1, done
        assert told(done)
