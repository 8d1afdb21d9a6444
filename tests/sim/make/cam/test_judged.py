"""Programs made of random drawings of known truth lie on it: `tests/tools/judged_programs.py` tries thousands."""

from pathlib import Path

import pytest
from judged_programs import verdict


@pytest.mark.alike(1)
@pytest.mark.parametrize("number", [0, 3, 8, 1015])  # the last one in yards
def test_the_decoded_path_of_a_random_drawing_is_the_true_one(number: int, tmp_path: Path) -> None:
    found = verdict(number, tmp_path)
    assert found.ending == "sound", found
