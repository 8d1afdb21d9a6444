"""What a scenario expects, held against the run."""

from dataclasses import replace

from sim.run.dryrun import DryRun
from sim.run.findings import expectation_findings
from sim.run.report import build_report
from sim.setup.expectations import missed


def check_expectations(run: DryRun) -> DryRun:
    """The run, with a finding for each expectation of its scenario that it does not meet."""
    if not run.scenario.expect:
        return run
    unmet = missed(build_report(run), run.scenario.expect)
    return replace(run, missed=unmet, findings=(*run.findings, *expectation_findings(unmet)))
