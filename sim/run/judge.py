"""What a scenario expects, held against the run."""

from dataclasses import replace

from sim.run.dryrun import DryRun
from sim.run.report import build_report
from sim.setup.expectations import compare


def check_expectations(run: DryRun) -> DryRun:
    """The run, with a finding for each expectation of its scenario that it does not meet."""
    expected = run.scenario.expect
    return replace(run, findings=(*run.findings, *compare(build_report(run), expected))) if expected else run
