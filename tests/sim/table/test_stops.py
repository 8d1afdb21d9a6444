"""What steppers lose against the stops of the travel."""

import math

import pytest
from runs import plain_scenario

from parser.program import parse_program
from sim.run.running import dry_run


def test_a_stepper_against_its_stop_loses_all_but_what_its_pull_out_holds() -> None:
    program = parse_program("B15000B0B15000GXL1 DD")
    found = dry_run(program, plain_scenario(start_mm=(399.0, 250.0), past_stop=True, may_stay_open=True))
    (loss,) = found.losses
    pull_out_um = 15_700.0 / 50.0 + 1.0 + 3.0  # at the 43.75 Hz of its steps: force over spring, slack, half a period
    assert loss.amount_um == math.ceil((14_000.0 - pull_out_um) / 6.0) * 6.0
    assert found.trace.table_um[-1, 0] == pytest.approx(1000.0, abs=1e-6)
