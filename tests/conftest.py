"""Settings for all tests: the same examples on every run, and no clock in the verdict."""

from hypothesis import settings

settings.register_profile("steady", deadline=None, derandomize=True)
settings.load_profile("steady")
