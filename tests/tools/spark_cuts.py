"""Cuts under sparks for tests: straight ones, and programs of a few blocks."""

import numpy as np

from controller.stepping.steps import interpolate, words_of
from parser.program import parse_program
from sim.process.way import Work

HEIGHT_UM = 40e3
WIRE_UM = 200.0
WIDTH_UM = 326.26
OPENING = "B0B1900B1900GYL4 B2900B0B2900GXL1 B0B3800B3800GYL2 B5800B0B5800GXL3 B0B3800B3800GYL4 B2900B0B2900GXL1 DD"
ARCS = "B300B0B300GXL1 B400B0B800GYNR1 B100B250B250GYL2 B0B200B800GXSR2 B150B40B150GXL3 DD"


def work_of(text: str, height_um: float = HEIGHT_UM, width_um: float = WIDTH_UM, wait_s: float = 0.0) -> Work:
    """A program of 3B as work, each of its blocks as wide."""
    toolpath = parse_program(text).toolpath
    n = len(toolpath)
    steps = interpolate(toolpath)
    return Work(
        steps,
        words_of(toolpath),
        toolpath,
        np.full(n, width_um),
        np.full(n, 10.0),
        np.full(n, wait_s),
        height_um,
        WIRE_UM,
        n,
    )


def straight(length_um: int, height_um: float = HEIGHT_UM) -> Work:
    """A straight cut along X."""
    return work_of(f"B{length_um}B0B{length_um}GXL1 DD", height_um)
