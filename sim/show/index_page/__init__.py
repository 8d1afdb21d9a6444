"""``index.html``: all programs of a shop on one page, to be searched, sorted and filtered (docs/batch.md)."""

from sim.show.index_page.page import BesideTheIndex, index_page

__all__ = ["BesideTheIndex", "index_page"]
