"""Settings for all tests: the same examples on every run, and no deadline on one of them; browsers for pages."""

import gc
from collections.abc import Generator

import pytest
from browser import browsers, open_page
from c_library import library
from depth import DEEP, examples
from hypothesis import settings

__all__ = ["browsers", "library", "open_page"]

settings.register_profile("steady", max_examples=examples(), deadline=None, derandomize=True)
settings.load_profile("steady")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave what takes long to ``make deep``: promises of size and time, and deaths of processes."""
    if DEEP:
        return
    long = [item for item in items if item.get_closest_marker("deeper")]
    config.hook.pytest_deselected(items=long)
    items[:] = [item for item in items if item not in long]


def pytest_collection_finish() -> None:
    """Look for cycles seldom, and never among the tests themselves: that took a tenth of the time of the parser's."""
    gc.freeze()
    gc.set_threshold(10_000, 20, 20)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport() -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Captured logs in UTF-8: ezdxf logs the bytes of damaged files, which no worker of several could report."""
    report = yield
    report.sections = [
        (name, text.encode("utf-8", "backslashreplace").decode("utf-8")) for name, text in report.sections
    ]
    return report
