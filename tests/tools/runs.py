"""Dry runs for tests."""

from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
from lawful import assert_plan_is_lawful
from places import SCENARIOS

from controller.motion.limits import row_limits
from controller.stepping.pulses import Pulses
from parser.program import parse_program
from sim.base.progress import silent
from sim.jobs.shop import program_read, source_of
from sim.run.dryrun import DryRun
from sim.run.recording import Recording, check_expectations, recorded
from sim.run.running import dry_run
from sim.setup.machine.machine import Machine, load_machine
from sim.setup.scenario import Scenario, load_scenario


def plain_scenario(**changes: object) -> Scenario:
    return replace(Scenario("test", Path("test.3b"), load_machine("dk7740")), **changes)


def machine(**table: object) -> Machine:
    """The shipped machine with some values of its table changed."""
    shipped = load_machine("dk7740")
    return shipped._replace(table=shipped.table._replace(**table))


def run_text(text: str, **changes: object) -> DryRun:
    return lawful(dry_run(parse_program(text), plain_scenario(**changes), silent))


def lawful(run: DryRun) -> DryRun:
    """The run, whose plan keeps its limits in the least time."""
    machine = run.scenario.machine
    limits = row_limits(run.toolpath, run.feeds, machine.controller.limits)
    assert_plan_is_lawful(run.plan, limits, jerk_um_s3=machine.controller.limits.jerk_um_s3)
    return run


def run_folder(folder: Path) -> DryRun:
    scenario = load_scenario(folder)
    return check_expectations(lawful(dry_run(program_read(scenario, source_of(scenario)), scenario, silent)))


@cache
def scenario_recording(name: str) -> Recording:
    """A scenario of the project with every step: run once for all tests of a process, which change nothing in it."""
    scenario = load_scenario(SCENARIOS / name)
    with recorded(program_read(scenario, source_of(scenario)), scenario, silent) as found:
        lawful(found.run)
        return found._replace(steps=Pulses(*(np.array(column) for column in found.steps)))


def scenario_run(name: str) -> DryRun:
    """The run of a scenario of the project, held to what it expects."""
    return scenario_recording(name).run


def codes(run: DryRun) -> list[str]:
    return [finding.code for finding in run.findings]
