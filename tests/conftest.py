"""Settings for all tests: the same examples on every run, and no deadline on one of them."""

from hypothesis import settings

settings.register_profile("steady", deadline=None, derandomize=True)
settings.load_profile("steady")
