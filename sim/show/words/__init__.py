"""Words for people in English and Chinese: `said` gives a text in both, `Words` in one; the texts are TOML files."""

from sim.show.words.words import Words, said

__all__ = ["Words", "said"]
