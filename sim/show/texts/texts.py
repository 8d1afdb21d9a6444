"""The one loader of words: texts in English and Chinese, side by side in the TOML files beside this module.

A key is ``file.text``: ``cut.kerf`` is the text `kerf` of ``cut.toml``. A file is read when one of its texts is first
asked for.
"""

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from parser.findings.catalogue import LANGUAGES, Bilingual, Language, in_language

if TYPE_CHECKING:
    pass

FOLDER: Final = Path(__file__).parent


class Words(NamedTuple):
    """The texts in one language."""

    language: Language

    def __call__(self, key: str, /, **values: object) -> str:
        """Text of a key, its places filled; of a value in both languages the text of the language is taken.

        KeyError where there is no such text.
        """
        file, _, name = key.partition(".")
        template = getattr(texts(file)[name], self.language)
        filled: str = template.format(**{name: in_language(value, self.language) for name, value in values.items()})
        return filled


def bilingual(key: str, /, **values: object) -> Bilingual:
    """Text of a key in both languages, as `Words` gives it in one."""
    return Bilingual(*(Words(language)(key, **values) for language in LANGUAGES))


@cache
def texts(file: str) -> Mapping[str, Bilingual]:
    """Templates of a file by their names. KeyError where there is no such file."""
    import tomllib  # noqa: PLC0415 - a check without findings needs no text

    path = FOLDER / f"{file}.toml"
    if not path.is_file():
        raise KeyError(file)
    return {name: Bilingual(**text) for name, text in tomllib.loads(path.read_text(encoding="utf-8")).items()}
