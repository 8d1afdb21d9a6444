"""``drycut explain``: pages of codes and documents as a terminal shows them."""

import json
import re
import tomllib

import jsonschema
import pytest
from command import run_inside
from places import ROOT

from parser.findings.catalogue import LANGUAGES, Language, example, page
from parser.findings.codes import CODES
from parser.text.places import cells
from sim.show.findings.pages import page_text
from sim.show.terminal.markdown import (
    cited,
    document,
    documents,
    files,
    plain,
    section,
    shown_lines,
    title,
)

RAW = re.compile(r"`|\*\*\w|\w\*\*|^#|\]\(|\.md\b|<!--|^\|", re.MULTILINE)


def explained(code: str, language: Language, width: int = 80) -> list[str]:
    return [line.text for line in shown_lines(cited(page_text(code, language)), width)]


def told(*arguments: str) -> str:
    done = run_inside("explain", *arguments)
    assert not done.returncode, done.stderr
    return done.stdout.decode()


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("width", [60, 80, 100])
def test_every_page_fits_without_a_sign_of_markdown(language: Language, width: int) -> None:
    for code in CODES:
        lines = explained(code, language, width)
        assert max(map(cells, lines)) <= width, code
        assert not RAW.search("\n".join(lines)), code
        assert "" not in (lines[0], lines[-1])


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_page_loses_nothing_but_the_signs(language: Language) -> None:
    for code in CODES:
        squeezed = "".join("".join(explained(code, language)).split())
        of, program = page(code, language), example(code)
        unfenced = re.sub("```.*", "", f"{of.why}\n\n{of.mend}")
        for text in (of.title, *unfenced.split("\n\n")):
            assert "".join(plain(cited(text)).split()) in squeezed, (code, text)
        assert not program or "".join(program.mended.split()) in squeezed


def test_a_page_has_headings_and_its_example_set_in() -> None:
    lines = list(shown_lines(cited(page_text("3B401", "en"))))
    heads = [text for text, is_heading in lines if is_heading]
    assert heads == [
        "3B401: out of travel (error)",
        "How to mend it:",
        "Example, checked with --machine dk7740:",
        "Mended:",
    ]
    assert "    B210000B0B210000GXL1" in [text for text, _ in lines]


@pytest.mark.parametrize("language", LANGUAGES)
def test_pages_cite_only_what_the_command_shows(language: Language) -> None:
    cites = 0
    for code in CODES:
        text = "".join("".join(explained(code, language)).split())
        for name, numbers in re.findall(r"drycutexplain(\w+?)((?:§\d[,、]?)*)(?!\w)", text):
            assert name in documents(), (code, name)
            for number in re.findall(r"\d+", numbers):
                assert section(document(name), number)
                cites += 1
    assert cites > 40


@pytest.mark.parametrize("file", files())
def test_a_document_fits_but_for_what_is_fenced(file: str) -> None:
    name, _, language = file.removesuffix(".md").partition(".")
    markdown = document(name, "zh" if language else "en")
    out = told(name, "--lang", language or "en")
    fenced = {
        line.strip() for block in re.findall(r"^```.*\n((?:.*\n)*?)```$", markdown, re.M) for line in block.split("\n")
    }
    assert not [line for line in out.splitlines() if cells(line) > 80 and line.strip() not in fenced]
    assert not RAW.search("\n".join(line for line in out.splitlines() if line.strip() not in fenced))
    assert markdown == (ROOT / "docs" / file).read_text(encoding="utf-8")


def test_a_document_is_shown_in_chinese_where_there_is_one() -> None:
    written = {path.stem.split(".")[0] for path in (ROOT / "docs").glob("*.zh.md")} & {*documents()}
    assert written
    for name in documents():
        assert (document(name, "zh") != document(name)) == (name in written)
        assert (title(name, "zh") != title(name)) == (name in written)


def test_a_wheel_brings_the_documents_of_users_and_the_examples() -> None:
    build = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]["hatch"]["build"]
    shipped = build["targets"]["wheel"]["force-include"]
    assert shipped == {f"docs/{name}": f"sim/docs/{name}" for name in files()} | {"scenarios": "sim/scenarios"}
    assert {"3b", "check", "scenarios"} < set(documents())
    assert not {"architecture", "code-flow", "findings", "record"} & set(documents())


def test_sections_of_a_document_are_shown_by_their_number() -> None:
    second = told("3b", "2")
    assert second.startswith("2. File\n")
    assert told("3B", "§2,", "§4").startswith(second)
    assert "\n4. Faults and their effect, measured\n" in told("3b", "§2,", "§4")


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["3B999"], "no finding has the code '3B999'"),
        (["../check"], "no document the name"),
        (["3b", "99"], "document '3b' has no section 99"),
        (["3b", "steps"], "document '3b' has no section steps"),
        (["3B204", "2"], "'3B204'"),
    ],
)
def test_what_there_is_not_is_said(arguments: list[str], complaint: str) -> None:
    done = run_inside("explain", *arguments)
    assert done.returncode == 2
    assert complaint in done.stderr.decode()


def test_the_list_fits() -> None:
    for language in LANGUAGES:
        out = told("--lang", language)
        assert max(map(cells, out.splitlines())) <= 80
        assert re.search(rf"\n    3b +{re.escape(title('3b', language))}\n", out)


def test_lists_tables_and_chinese_keep_their_form() -> None:
    lists = "# A\none `b|c`\ntwo\n\n* x\n  y\n* z\n\n"
    text = lists + "| a | b |\n|---|---|\n| `1 \\| 2` | three four |\n\n中文，\n2 字\n字"
    assert [line.text for line in shown_lines(text, 14)] == [
        "A",
        "one b|c two",
        "",
        "* x y",
        "* z",
        "",
        "a      b",
        "-----  -------",
        "1 | 2  three",
        "       four",
        "",
        "中文，2 字字",
    ]


def test_a_search_finds_the_pages_with_all_the_words_in_either_language() -> None:
    out = told("--search", "Count AXIS")
    codes = re.findall(r"^ +(\S+)  ", out, re.MULTILINE)
    assert "3B204" in codes[:3]
    for code in (each for each in codes if each in CODES):
        texts = [
            f"{page(code, language).title} {page(code, language).why} {page(code, language).mend}"
            for language in LANGUAGES
        ]
        assert all(word in " ".join(texts).casefold() for word in ("count", "axis")), code
    assert set(re.findall(r"^ +(\S+)  ", told("--search", "计数"), re.MULTILINE)) >= {"3B204", "3b"}
    done = run_inside("explain", "--search", "xyzzy")
    assert (done.returncode, done.stdout) == (2, b"")
    assert "no page has all the words of 'xyzzy'" in done.stderr.decode()


@pytest.mark.parametrize("language", LANGUAGES)
def test_pages_as_json_fit_their_schema_and_say_what_the_pages_say(language: Language) -> None:
    schema = json.loads((ROOT / "docs" / "explain.schema.json").read_text("utf-8"))
    every = json.loads(told("--json", "--lang", language))
    jsonschema.Draft202012Validator(schema).validate(every)
    assert [entry["code"] for entry in every["codes"]] == sorted(CODES)
    assert [entry["name"] for entry in every["documents"]] == list(documents())
    (one,) = json.loads(told("3b204", "--json", "--lang", language))["codes"]
    assert one in every["codes"]
    assert (one["title"], one["severity"]) == (page("3B204", language).title, "error")
    (whole,) = json.loads(told("check", "--json", "--lang", language))["documents"]
    assert whole["text"] == document("check", language)
    assert run_inside("explain", "3b", "2", "--json").returncode == 2
