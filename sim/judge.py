"""What a scenario expects, held against the run."""

from dataclasses import replace

from sim.dryrun import DryRun
from sim.expect import compare
from sim.report import build_report


def check_expectations(run: DryRun) -> DryRun:
    """The run, with a finding for each expectation of its scenario that it does not meet."""
    expected = run.scenario.expect
    return replace(run, findings=(*run.findings, *compare(build_report(run), expected))) if expected else run
