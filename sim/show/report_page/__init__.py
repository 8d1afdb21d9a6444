"""``report.html``: the run as one page for people, in English and Chinese (docs/report.md)."""

from sim.show.report_page.page import report_page

__all__ = ["report_page"]
