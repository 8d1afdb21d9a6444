"""Replays of long programs on a table that stands where it is told: dry-running them takes minutes."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
from chunked import chunks_of
from replayed import recording_of
from runs import plain_scenario

from controller.stepping.pulses import Pulses, time_steps
from parser.program import parse_program
from sim.measure.causes import StepTally
from sim.run.dryrun import DryRun
from sim.run.prepare import prepare
from sim.run.recording import Recording
from sim.show.replay.document import replay_page
from sim.table.motion import motion_of
from sim.table.ticks import Sampling
from sim.table.trace import Trace, origin_um


def long_page(text: str) -> str:
    """Page of a program, its wire within a µm of its command, sampled at every fifth step."""
    small = recording_of("B0B300B300GYL2 B300B200B300GXL4 B300B100B300GXL3 DD")
    program = parse_program(text)
    scenario = plain_scenario(may_stay_open=True)
    ready = prepare(program, scenario)
    machine, sampling = scenario.machine, Sampling(5.0)
    motion = motion_of(program.toolpath, machine.feeds(40.0), machine, scenario.start_um, sampling)
    timed = [time_steps(chunk, motion.drive.plan) for chunk in chunks_of(ready.steps)]
    pulses = Pulses._make(np.concatenate(column) for column in zip(*timed, strict=True))
    return replay_page(Recording(_ran(small.run, program, motion.drive.plan, pulses), small.pieces, pulses))


def _ran(run: DryRun, program: object, plan: object, pulses: Pulses) -> DryRun:
    tally = StepTally(len(program.toolpath), origin_um(program.toolpath))
    tally.take(pulses)
    stepped = tally.result()
    ends = np.cumsum(stepped.count) - 1
    border = np.concatenate([[0.0], pulses.t_s[ends][:-1], [plan.duration_s]])
    every = np.arange(0, len(pulses.t_s), 5)
    place = np.column_stack([pulses.x_um[every], pulses.y_um[every]]).astype(float)
    t = np.concatenate([[0.0], pulses.t_s[every] + 1e-3])
    place, row = np.vstack([[[0.0, 0.0]], place]), np.concatenate([[0], pulses.row[every]]).astype(np.int64)
    wobble = np.column_stack([np.sin(t * 3.0), np.cos(t * 2.0)])
    trace = Trace(t, place, place + wobble, place + wobble, row)
    return replace(
        run,
        program=program,
        plan=plan,
        stepped=stepped,
        trace=trace,
        border_s=border,
        findings=(),
        contours=(),
    )


def rippled_spiral(blocks: int, turns: int = 8) -> str:
    """So many lines, up and down within a fraction of a pixel, on a spiral that the wire does not cross."""
    places = [_on_spiral(at / blocks, turns, 30 * (at % 2)) for at in range(blocks + 1)]
    moves = ((x - px, y - py) for (px, py), (x, y) in pairwise(places))
    return "\n".join([*(_line(dx, dy) for dx, dy in moves if dx or dy), "DD", ""])


def _on_spiral(share: float, turns: int, out_um: int) -> tuple[int, int]:
    radius, angle = 2000 + 8000 * share + out_um, 2 * math.pi * turns * share
    return round(radius * math.cos(angle)), round(radius * math.sin(angle))


def _line(dx: int, dy: int) -> str:
    x, y = abs(dx), abs(dy)
    sense = (1 if dy >= 0 else 4) if dx > 0 else (2 if dy > 0 else 3)
    return f"B{x}B{y}B{max(x, y)}G{'X' if x >= y else 'Y'}L{sense}"
