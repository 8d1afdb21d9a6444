"""Words for people in English and Chinese: `bilingual` gives a text in both, `Words` in one; they are TOML files."""

from sim.show.texts.texts import Words, bilingual

__all__ = ["Words", "bilingual"]
