"""Where the project's files are, for tests that read them."""

from pathlib import Path

ROOT = Path(__file__).parents[2]
SCENARIOS = ROOT / "scenarios"
MACHINES = ROOT / "sim" / "setup" / "machine"
CORPUS = ROOT / "tests" / "corpus"
DATA = ROOT / "tests" / "data"
