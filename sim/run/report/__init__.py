"""``report.json``: the run as data, schema ``drycut.report/1`` (docs/report.md)."""

from sim.run.report.document import build_report, report_text

__all__ = ["build_report", "report_text"]
