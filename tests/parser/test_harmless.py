"""What terminals and build servers obey, told by their own rules, and not by those of the code under test."""

import random
import re

import pytest

from parser.text.encoding import escaped, harmless, printable

# docs.github.com, "Workflow commands".
NAMES = ["error", "warning", "notice", "debug", "group", "endgroup", "add-mask", "set-output", "save-state", "echo"]
PARTS = [
    *(
        "##",
        "#",
        ":",
        "::",
        "[",
        "]",
        "vso",
        "[task.setvariable variable=x]y",
        "teamcity[a b='c']",
        "section_start:1:a",
    ),
    *("\x1b[31m", "\x1b]8;;http://x\x07", "\x9b2J", "\u202e", "\u2066", "\u200b", "\ufe0f", "\u034f", "\xad", "\x00"),
    *(
        "\r",
        "\n",
        "\t",
        "\u2028",
        "\x85",
        " ",
        "\u3000",
        "\xa0",
        "µm",
        "零件",
        "🙂",
        "\ud800",
        "a",
        "%0A",
        "//",
        "B9 B0",
    ),
    *(f"::{name} ::" for name in NAMES),
]
# What .NET's comparison by culture does not see (docs.microsoft.com, "ignorable characters"), as far as it is printed.
UNSEEN = re.compile("[\u034f\ufe00-\ufe0f\u200b-\u200f\xad]")


def obeyed(line: str) -> list[str]:
    """Which reader would take something in a line for a command to itself."""
    seen = UNSEEN.sub("", line)
    readers = {
        "a terminal": re.search(r"[\x00-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]", line),
        "GitHub's runner, as it was": re.search(r"##\[", seen),
        "GitHub's runner": re.match(r"\s*::", seen),
        "another runner": re.search(rf"::({'|'.join(NAMES)})( [^:]*)?::", seen),
        "Azure's agent": re.search(r"##vso\[", seen, re.IGNORECASE),
        "TeamCity": re.search(r"##teamcity\[", seen),
        "GitLab": re.search(r"section_(start|end):\d+:", seen),
        "an encoder": re.search("[\ud800-\udfff]", line),
    }
    return [name for name, found in readers.items() if found]


def test_no_reader_obeys_what_is_harmless() -> None:
    drawn = random.Random(17)
    for _ in range(4_000):
        line = "".join(drawn.choices(PARTS, k=drawn.randrange(1, 8)))
        shown = harmless(line)
        assert obeyed(shown) == [], (line, shown)
        assert (len(shown), harmless(shown)) == (len(line), shown)


@pytest.mark.parametrize("part", ["##vso[a]b", "x ##[error]y", " ::error ::z", "a ::set-output name=b::c", "\x1b[1mq"])
def test_each_reader_would_have_obeyed(part: str) -> None:
    assert obeyed(part)


@pytest.mark.parametrize(
    "text",
    [
        *("part.3b:2:14: error[3B204]: wrong count axis", "a::b.3b", "std::vector::x", "#1.3b", "a##b", "## Files [x]"),
        *("µm 零件　加工 🙂 é", "C:\\a\\b.3b", "x:y", "12:30", "|: a", "[a]: b", "a ::error b", "sections: 3"),
    ],
)
def test_texts_of_people_stay(text: str) -> None:
    assert harmless(text) == printable(text) == text


def test_a_format_keeps_what_it_escapes() -> None:
    text = '{"a": "##vso[x]"}\n  ::error ::b\x1b'
    assert escaped(text, lambda char: f"<{ord(char)}>") == '{"a": "<35>#vso[x]"}\n  <58>:error ::b<27>'


def test_a_long_line_takes_no_longer_than_its_length() -> None:
    for part in ("#", ":", "::error ", "\ufe0f", "section_start", "##a"):
        harmless(part * 200_000)
