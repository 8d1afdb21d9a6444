"""Settings for all tests: the same examples on every run, and no deadline on one of them; browsers for pages."""

import gc
import os
from collections.abc import Generator

import pytest
from browser import browsers, open_page
from c_library import library
from depth import DEEP, examples, spread
from hypothesis import settings

__all__ = ["browsers", "library", "open_page"]

settings.register_profile("steady", max_examples=examples(), deadline=None, derandomize=True)
settings.load_profile("steady")


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave to ``make deep`` what takes long: promises of size and time, deaths of processes, most of what is alike.

    A test that is named, as ``tests/test_some.py::test_this``, is tried whole.
    """
    if DEEP or any("::" in name for name in config.args):
        return
    long = {id(item) for item in items if item.get_closest_marker("deeper")} | _more_of_a_kind(items)
    config.hook.pytest_deselected(items=[item for item in items if id(item) in long])
    items[:] = [item for item in items if id(item) not in long]


def _more_of_a_kind(items: list[pytest.Item]) -> set[int]:
    """Cases, by the places of their items, for which others stand in the suite."""
    cases: dict[tuple[str, int], list[pytest.Item]] = {}
    for item in items:
        if mark := item.get_closest_marker("alike"):
            cases.setdefault((item.nodeid.partition("[")[0], *mark.args), []).append(item)
    tried = {key: spread(key[1], len(alike)) for key, alike in cases.items()}
    return {id(item) for key, alike in cases.items() for at, item in enumerate(alike) if at not in tried[key]}


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers() -> int:
    """One process more than cores: tests of pages and servers wait for an eighth of the time."""
    return (os.cpu_count() or 1) + 1


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
