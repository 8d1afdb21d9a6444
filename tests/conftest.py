"""Settings for all tests: the same examples on every run, and no deadline on one of them; browsers for pages."""

from collections.abc import Generator

import pytest
from browser import browsers, open_page
from c_library import library
from hypothesis import settings

__all__ = ["browsers", "library", "open_page"]

settings.register_profile("steady", deadline=None, derandomize=True)
settings.load_profile("steady")


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport() -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Captured logs in UTF-8: ezdxf logs the bytes of damaged files, which no worker of several could report."""
    report = yield
    report.sections = [
        (name, text.encode("utf-8", "backslashreplace").decode("utf-8")) for name, text in report.sections
    ]
    return report
