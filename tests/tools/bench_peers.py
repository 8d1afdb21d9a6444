"""Two programs that read the same path: Klipper's batch mode, and rs274 of LinuxCNC. Nothing of theirs is kept here.

Klipper plans, steps and packs every step for a controller; it is found in the folder DRYCUT_BENCH_KLIPPER, its source
with `out/klipper.dict` of the Linux target (Klipper's docs/Debugging.md), and started by the Python that
DRYCUT_BENCH_KLIPPER_PYTHON names, which has cffi, greenlet, jinja2 and pyserial. rs274 reads and writes each move in
words of its own; it is found by DRYCUT_BENCH_RS274 or in PATH.
"""

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

from bench_cpu import Used, used_by

from parser.program import read_program
from parser.toolpath import Toolpath

KLIPPER_MISSING = (
    "no Klipper: get github.com/Klipper3d/klipper, `make` it for the Linux target, and set DRYCUT_BENCH_KLIPPER to its "
    "folder, DRYCUT_BENCH_KLIPPER_PYTHON to a Python with cffi, greenlet, jinja2 and pyserial"
)
RS274_MISSING = "no rs274: apt install linuxcnc-uspace, or set DRYCUT_BENCH_RS274 to that program"
FEED_MM_MIN = 2.625

_STILL_S = 2.0  # without a byte: then Klipper has written all, which it does behind its reading
_STEPPER = """
[stepper_{axis}]
step_pin: gpio{pin}
dir_pin: gpio{dir}
enable_pin: !gpio{enable}
microsteps: 1
rotation_distance: 0.2
endstop_pin: ^gpio{stop}
position_endstop: -1000
position_min: -1000
position_max: 1000
"""
_PRINTER = """
[mcu]
serial: /dev/null
[printer]
kinematics: cartesian
max_velocity: 10
max_accel: 100
max_z_velocity: 5
max_z_accel: 30
square_corner_velocity: 0.5
minimum_cruise_ratio: 0
[force_move]
enable_force_move: True
""" + "".join(
    _STEPPER.format(axis=axis, pin=at, dir=at + 1, enable=at + 2, stop=at + 3)
    for axis, at in (("x", 0), ("y", 4), ("z", 8))
)


def rs274() -> str | None:
    """The program, where there is one."""
    return os.environ.get("DRYCUT_BENCH_RS274") or shutil.which("rs274")


def klipper() -> Path | None:
    """Klipper's folder, where there is one with its dictionary."""
    folder = Path(os.environ.get("DRYCUT_BENCH_KLIPPER") or "/nowhere")
    return folder if (folder / "out" / "klipper.dict").is_file() else None


def in_iso(path: Path) -> Path:
    """A path in words that rs274 and drycut both read, arcs as arcs: a file beside it, written once."""
    words = path.with_suffix(".ngc")
    if not words.exists():
        words.write_text(_arcs(read_program(path).toolpath), encoding="ascii")
    return words


def rs274_used(program: str, path: Path) -> Used:
    """What rs274 takes for a path in ISO, into a file; the folder of the path takes what it needs."""
    folder, words = path.parent, in_iso(path)
    (folder / "tools.tbl").touch()
    (folder / "numbers.var").touch()
    named = ["-t", str(folder / "tools.tbl"), "-v", str(folder / "numbers.var")]
    return used_by([program, *named, "-g", str(words), str(folder / "path.canon")])


def klipper_cpu_s(source: Path, path: Path) -> float:
    """CPU seconds of Klipper's batch mode for a path, of lines to the same ends, 1 µm a step, all steps written."""
    folder = path.parent
    words, config, steps = folder / "path.gcode", folder / "printer.cfg", folder / "path.serial"
    if not words.exists():
        lines = _lines(read_program(path).toolpath)
        words.write_text(f"SET_KINEMATIC_POSITION X=0 Y=0 Z=0\nG90\nG1 F{FEED_MM_MIN}\n{lines}", encoding="ascii")
        config.write_text(_PRINTER, encoding="ascii")
        _batch(source, words, config, steps)  # the first time it compiles its helper
    return _batch(source, words, config, steps)


def _batch(source: Path, words: Path, config: Path, steps: Path) -> float:
    """Klipper ends with its input, whatever it has still to write: so the input stays open until nothing more comes."""
    python = os.environ.get("DRYCUT_BENCH_KLIPPER_PYTHON") or sys.executable
    dictionary = str(source / "out" / "klipper.dict")
    command = [python, str(source / "klippy" / "klippy.py"), str(config), "-i", "/dev/stdin", "-o", str(steps)]
    steps.unlink(missing_ok=True)
    quiet = subprocess.DEVNULL
    process = subprocess.Popen([*command, "-d", dictionary], stdin=subprocess.PIPE, stdout=quiet, stderr=quiet)
    assert process.stdin is not None
    process.stdin.write(words.read_bytes())
    process.stdin.flush()
    written = -1
    while process.poll() is None:
        size = steps.stat().st_size if steps.exists() else 0
        if size == written > 0:
            break
        written = size
        time.sleep(_STILL_S)
    process.stdin.close()
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        raise RuntimeError(f"Klipper's batch mode ended with {process.returncode}")
    return used.ru_utime + used.ru_stime


def _lines(toolpath: Toolpath) -> str:
    return "".join(f"G1 X{x:.4f} Y{y:.4f}\n" for x, y in (toolpath.end_um / 1000.0).tolist())


def _arcs(toolpath: Toolpath) -> str:
    """The path as RS274 words: G1, and G2 and G3 with centres from the start of the block."""
    end, start, center = (column / 1000.0 for column in (toolpath.end_um, toolpath.start_um, toolpath.center_um))
    rows = zip(end.tolist(), (center - start).tolist(), toolpath.sweep_rad.tolist(), strict=True)
    words = [f"G21 G90 G91.1 G17\nG1 F{FEED_MM_MIN}\n"]
    for (x, y), (i, j), sweep in rows:
        way = f" I{i:.6f} J{j:.6f}" if sweep else ""
        words.append(f"{('G1', 'G3', 'G2')[(sweep > 0) - (sweep < 0)]} X{x:.6f} Y{y:.6f}{way}\n")
    return "".join([*words, "M2\n"])
