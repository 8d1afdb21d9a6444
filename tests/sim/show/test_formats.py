"""The formats of a check against their schemas, with kind texts and hostile ones."""

import codecs
import json
import re
import subprocess
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import pytest
import xmlschema
from check_results import AXIS, CHECKS, COUNTED, HOSTILE, hostile, kind, parsed, quieted, result, unknown
from jsonschema import Draft202012Validator
from places import ROOT

from parser.findings.catalogue import LANGUAGES, Language, term, texts
from parser.findings.codes import CODES, Check
from parser.findings.findings import Finding
from sim.check.file_check import Job, check_file
from sim.check.result import CheckResult, Coverage, FailOn
from sim.check.settings import CheckSettings
from sim.check.settings.read import FAIL_ON
from sim.show.findings import FORMATS, render
from sim.show.findings.totals import spot
from sim.show.findings.wording import Options
from sim.show.terminal.printer import printed_text

SCHEMAS = {
    "json": ROOT / "docs" / "check.schema.json",
    "sarif": ROOT / "tests" / "schemas" / "sarif.schema.json",
    "gitlab": ROOT / "tests" / "schemas" / "gitlab.schema.json",
}
EVERY = [("kind", kind), ("hostile", hostile), ("quieted", quieted), ("none", list)]


def written(name: str, results: list[CheckResult], language: Language = "en", **options: Any) -> str:
    return "".join(render(name, iter(results), Options(language, **options)))


@cache
def validator(name: str) -> Draft202012Validator:
    schema = json.loads(SCHEMAS[name].read_text(encoding="utf-8"))
    Draft202012Validator.check_schema(schema)
    return Draft202012Validator(schema)


def complaints(name: str, value: object) -> list[str]:
    return [f"{error.json_path}: {error.message}" for error in validator(name).iter_errors(value)]


@cache
def junit_schema() -> xmlschema.XMLSchema:
    return xmlschema.XMLSchema(ROOT / "tests" / "schemas" / "junit.xsd")


def load(name: str, results: list[CheckResult], language: Language = "en") -> Any:
    return json.loads(written(name, results, language))


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("results", [make for _, make in EVERY], ids=[name for name, _ in EVERY])
class TestEveryFormat:
    def test_json_sarif_and_gitlab_fit_their_schemas(self, results: Any, language: Language) -> None:
        for name in SCHEMAS:
            assert complaints(name, load(name, results(), language)) == []

    def test_junit_fits_its_schema(self, results: Any, language: Language) -> None:
        for fail_on in FAIL_ON:
            strict = [replace(one, fail_on=fail_on) for one in results()]
            junit_schema().validate(parsed(written("junit", strict, language)))

    def test_the_same_results_give_the_same_bytes(self, results: Any, language: Language) -> None:
        for name in FORMATS:
            first = written(name, results(), language, statistics=True)
            assert written(name, results(), language, statistics=True) == first
            assert first.encode("utf-8")
            assert not first or first.endswith("\n")

    def test_no_control_character_but_the_line_feed_gets_out(self, results: Any, language: Language) -> None:
        for name in FORMATS:
            text = written(name, results(), language, statistics=True)
            assert not [char for char in text if ord(char) < 0x20 and char != "\n"]

    def test_machine_formats_are_ascii(self, results: Any, language: Language) -> None:
        for name in ("json", "sarif", "junit", "gitlab"):
            assert written(name, results(), language).isascii()


def test_results_are_written_as_they_come() -> None:
    taken = 0

    def endless() -> Any:
        nonlocal taken
        while True:
            taken += 1
            yield result("a.3b", AXIS)

    for name in FORMATS:
        taken = 0
        pieces = render(name, endless(), Options())
        for _ in range(20):
            next(pieces)
        assert taken <= 20


# Text


def test_text_points_at_what_it_means() -> None:
    lines = written("text", kind()[1:2]).splitlines()
    at = next(index for index, line in enumerate(lines) if "error[3B204]" in line)
    assert lines[at] == f"dir/part 1.3b:2:15: error[3B204]: {texts(AXIS).title}"
    assert lines[at + 1] == f"  2 | {COUNTED}"
    assert lines[at + 2] == "  " + "  | " + " " * 14 + "^^"
    assert lines[at + 3 : at + 9] == [
        "    = found:    block 2: the block counts on X, and its steps end 140.70 µm from",
        "                its exact end",
        "    = expected: GY, whose steps end 0.40 µm from it",
        "    = machine:  the table stops there, and all later blocks are shifted by as",
        "                much",
        "    = hint:     write GY, with J 39600",
    ]


def test_text_of_a_finding_without_a_place_names_the_file_alone() -> None:
    first = written("text", [result("a.3b", Finding("3B102"))]).splitlines()[0]
    assert first.startswith("a.3b: note[3B102]: ")


def test_text_of_a_finding_of_a_whole_line_shows_the_line_without_a_caret() -> None:
    lines = written("text", kind()[1:2]).splitlines()
    assert lines[0].startswith("dir/part 1.3b:1: warning[3B205]: ")
    assert lines[1] == "  1 | B B B GX L1"
    assert "^" not in lines[2]


def test_text_tells_how_far_the_check_came() -> None:
    assert written("text", kind()[1:2]).splitlines()[-3:] == [
        "dir/part 1.3b: fail: 1 error, 1 warning, 1 note; 6 of 7 blocks read, 6 decoded,",
        "    5 stepped; checks: 3 complete, 1 incomplete, 1 not asked",
        f"    {term('check-crossings')}: {term('reason-many')}",
    ]
    assert written("text", kind()[:1]) == (
        "good.3b: pass; 6 of 7 blocks read, 6 decoded, 5 stepped; checks: 3 complete\n"
    )
    whole = Coverage(3, 3, 3, 3, CHECKS[:3])
    assert written("text", [result("good.3b", coverage=whole)]) == "good.3b: pass; 3 blocks; checks: 3 complete\n"


def test_text_names_the_settings_and_what_is_not_shown() -> None:
    lines = written("text", quieted()).splitlines()
    assert "quiet.3b" not in lines[0]  # what passes without a finding has no line of its own among several
    assert lines[-5:] == [
        "told.3b: fail: 1 error; 6 of 7 blocks read, 6 decoded, 5 stepped; checks:",
        "    3 complete; settings: shop/drycut.toml",
        "3 files: 2 pass, 1 fail; 1 error, 11 not shown",
        "not shown: 1 by options, 2 by settings (shop/drycut.toml), 3 by remarks in the",
        "    program, 5 in the baseline",
    ]
    assert written("text", quieted()[:1]).splitlines() == [
        "quiet.3b: pass: 10 not shown; 6 of 7 blocks read, 6 decoded, 5 stepped; checks:",
        "    3 complete",
        "    not shown: 1 by options, 2 by settings (shop/drycut.toml), 3 by remarks in",
        "        the program, 4 in the baseline",
    ]


def test_quiet_text_says_what_is_not_shown_in_all_files_together() -> None:
    assert written("text", quieted()[2:] * 3, quiet=True) == "not shown: 3 in the baseline\n"
    named = [replace(quieted()[0], settings_file=f"{at}.toml") for at in range(5)]
    assert "10 by settings (0.toml, 1.toml, 2.toml, and 2 more)" in " ".join(written("text", named, quiet=True).split())


def test_text_sums_up_several_files() -> None:
    assert written("text", kind()).splitlines()[-1] == (
        "3 files: 1 pass, 1 fail, 1 incomplete; 1 error, 1 warning, 1 note"
    )


def test_quiet_text_is_silent_on_good_files() -> None:
    assert written("text", kind()[:1] * 3, quiet=True) == ""
    quiet = written("text", kind(), quiet=True)
    assert "good.3b" not in quiet
    assert "halt.3b: incomplete; " in quiet


def test_text_in_chinese() -> None:
    text = written("text", kind(), "zh", statistics=True)
    assert f"错误[3B204]: {texts(AXIS, 'zh').title}\n" in text
    assert "= 发现：第 2 段：本段按 X 计数" in text
    assert f"= 提示：{texts(AXIS, 'zh').hint}" in text
    assert "good.3b" not in text
    sound = written("text", kind()[:1], "zh")
    assert sound == "good.3b: 通过；共 7 段，读入 6 段，解码 6 段，走步 5 段；检查：3 项查完\n"
    for word in ("error", "warning", "blocks", "pass", "complete"):
        assert word not in text


def test_colours_come_only_when_asked_for() -> None:
    plain = written("text", kind())
    coloured = printed_text(written("text", kind(), colour=True), "text", colour=True)
    assert "\x1b" not in plain
    assert "\x1b[1;31merror[3B204]\x1b[0m" in coloured
    import click

    assert click.unstyle(coloured) == plain


def test_statistics_count_by_code() -> None:
    table = written("text", kind()[1:2] * 2, statistics=True).splitlines()[-10:]
    assert table[0].split()[:3] == ["code", "severity", "count"]
    assert [row.split()[:3] for row in table[1:4]] == [
        ["3B102", "note", "2"],
        ["3B204", "error", "2"],
        ["3B205", "warning", "2"],
    ]
    assert texts(AXIS).title in table[2]
    heads = ["files", "incomplete", "not asked", "blocks", "steps", "path length"]
    assert [row.split("  ")[0] for row in table[4:]] == heads
    assert table[4].endswith("2 (2 fail)")
    assert table[5].endswith(f"{term('check-crossings')} 2")
    assert table[6].endswith(f"{term('check-travel')} 2")
    assert table[8].endswith("79,200")
    assert table[9].endswith("124.408 mm")


def test_statistics_count_what_is_not_shown() -> None:
    table = written("text", quieted(), statistics=True)
    assert "not shown    1 by options, 2 by settings (shop/drycut.toml), 3 by remarks in the\n" in table


def test_no_line_of_text_is_a_command_to_a_build_server() -> None:
    results = [result("a.3b", unknown("::error::x"), excerpts={3: "::error::x"})]
    assert not [line for line in written("text", results).splitlines() if line.lstrip().startswith("::")]


# JSON


def test_json_holds_what_was_found() -> None:
    value = load("json", kind())
    assert (value["schema"], value["verdict"], value["language"]) == ("drycut.check/1", "fail", "en")
    assert [file["verdict"] for file in value["files"]] == ["pass", "fail", "incomplete"]
    finding = value["files"][1]["findings"][1]
    assert (finding["line"], finding["column"], finding["end_column"], finding["block"]) == (2, 15, 17, 2)
    assert finding["values"] == dict(AXIS.values)
    assert finding["edits"] == [{"first": 22, "past": 24, "text": "GY"}]
    assert value["totals"]["codes"] == {"3B102": 1, "3B204": 1, "3B205": 1}
    assert value["totals"]["files"] == {"checked": 3, "pass": 1, "fail": 1, "incomplete": 1, "to_check": 0}
    assert value["totals"]["length_um"] == round(3 * 62204.1234567, 6)
    states = [check["state"] for check in value["files"][1]["coverage"]["checks"]]
    assert states == [check.state for check in CHECKS]


def test_json_says_null_where_there_is_no_place() -> None:
    finding = load("json", [result("a.3b", Finding("3B102"))])["files"][0]["findings"][0]
    assert [finding[key] for key in ("line", "column", "end_column", "block")] == [None] * 4


def test_json_schema_refuses_a_key_more_or_less_anywhere() -> None:
    value = load("json", kind())
    file = value["files"][1]
    for node in (value, value["totals"], file, file["coverage"], file["coverage"]["checks"][3], file["findings"][1]):
        assert complaints("json", value) == []
        node["surplus"] = 1
        assert complaints("json", value)
        del node["surplus"]
        for key in list(node):
            kept = node.pop(key)
            assert complaints("json", value), key
            node[key] = kept


# SARIF


def test_sarif_places_and_mends() -> None:
    run = load("sarif", kind())["runs"][0]
    axis = next(entry for entry in run["results"] if entry["ruleId"] == "3B204")
    place = axis["locations"][0]["physicalLocation"]
    assert place["artifactLocation"] == {"uri": "dir/part%201.3b", "uriBaseId": "%SRCROOT%", "index": 1}
    assert place["region"] == {
        "startLine": 2,
        "startColumn": 15,
        "endLine": 2,
        "endColumn": 17,
        "snippet": {"text": COUNTED[14:16]},
    }
    change = axis["fixes"][0]["artifactChanges"][0]
    assert change["replacements"] == [
        {"deletedRegion": {"charOffset": 22, "charLength": 2}, "insertedContent": {"text": "GY"}}
    ]
    assert [run["artifacts"][1]["encoding"], axis["level"]] == ["GB18030", "error"]


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "gb18030", "big5", "latin-1"])
def test_sarif_names_every_encoding_as_its_registry_does(encoding: str) -> None:
    codec = codecs.lookup(encoding.removesuffix("-sig"))
    remark = "caf\xe9" if encoding == "latin-1" else "線切割加工程式" if encoding == "big5" else "线切割加工程序"
    data = f"{COUNTED}\nDD\n;{remark}\n".encode(encoding)
    run = load("sarif", [check_file(Job("part.3b", data, CheckSettings()))])["runs"][0]
    assert codecs.lookup(run["artifacts"][0]["encoding"]) == codec


def test_sarif_rules_are_the_codes() -> None:
    run = load("sarif", kind())["runs"][0]
    rules = run["tool"]["driver"]["rules"]
    assert [rule["id"] for rule in rules] == sorted(CODES)
    for entry in run["results"]:
        assert rules[entry["ruleIndex"]]["id"] == entry["ruleId"]
    assert len({rule["name"] for rule in rules}) == len(rules)
    chinese = load("sarif", kind(), "zh")["runs"][0]["tool"]["driver"]["rules"]
    assert [rule["name"] for rule in chinese] == [rule["name"] for rule in rules]


def test_sarif_tells_of_checks_that_did_not_end() -> None:
    invocation = load("sarif", kind())["runs"][0]["invocations"][0]
    assert invocation["executionSuccessful"]
    assert [notice["descriptor"]["id"] for notice in invocation["toolExecutionNotifications"]] == [
        "check-crossings"
    ] * 2
    assert not load("sarif", hostile())["runs"][0]["invocations"][0]["executionSuccessful"]


def prints(*findings: Finding, **changes: Any) -> list[str]:
    run = load("sarif", [result("a.3b", *findings, **changes)])["runs"][0]
    return [entry["partialFingerprints"]["drycutBlock/v1"] for entry in run["results"]]


def test_fingerprints_stay_when_lines_are_put_in_above() -> None:
    moved = AXIS._replace(line=9, block=5, span=(80, 82))
    assert prints(AXIS) == prints(moved, excerpts={9: f"  {COUNTED} "})
    first, second = prints(AXIS, moved, excerpts={2: COUNTED, 9: COUNTED})
    assert first != second
    assert prints(AXIS) != prints(AXIS, excerpts={2: "B0B9900B39600GXNR1"})


def test_sarif_file_names_come_back() -> None:
    uris = [artifact["location"]["uri"] for artifact in load("sarif", hostile())["runs"][0]["artifacts"]]
    assert unquote(uris[2]) == "::error::a,b:c%.3b"
    assert ":" not in uris[2]
    assert unquote(uris[3]).endswith("/srv/零件.3b")
    assert uris[3].startswith("file:///")


# JUnit


def test_junit_has_a_case_for_each_check() -> None:
    suite = parsed(written("junit", kind()))[1]
    outcomes = {case.get("name"): [child.tag for child in case] for case in suite.iter("testcase")}
    assert outcomes == {
        term("check-grammar"): [],
        term("check-blocks"): [],
        term("check-steps"): ["failure"],
        term("check-crossings"): ["error"],
        term("check-travel"): ["skipped"],
    }
    counts = {key: suite.get(key) for key in ("tests", "failures", "errors", "skipped")}
    assert counts == {"tests": "5", "failures": "1", "errors": "1", "skipped": "1"}
    assert "3B205" in suite.findtext("system-out", "")


@pytest.mark.parametrize(("fail_on", "failures"), [("error", 1), ("incomplete", 1), ("warning", 2)])
def test_junit_fails_on_what_was_asked_for(fail_on: FailOn, failures: int) -> None:
    strict = replace(kind()[1], fail_on=fail_on)
    suite = parsed(written("junit", [strict]))[0]
    assert suite.get("failures") == str(failures)


def test_a_failed_check_that_is_also_incomplete_fails_and_says_so() -> None:
    crossing = Finding("3B307", {"crossing": 4, "other": 2, "x": 1.0, "y": 2.0, "more": 0}, line=1, column=1, block=4)
    failed = result("a.3b", crossing, coverage=Coverage(1, 1, 1, 1, CHECKS))
    suite = parsed(written("junit", [replace(failed, fail_on="warning")]))[0]
    assert (suite.get("failures"), suite.get("errors")) == ("1", "0")
    assert term("reason-many") in suite.findtext("testcase/failure", "")


def test_every_code_of_a_check_belongs_to_one() -> None:
    of_a_run = {
        code for code in CODES if "3B401" < code < "3B700" or code in {"3B708", "3B711"} or code.startswith("GEC")
    }
    assert {code for code, of in CODES.items() if of.check} == set(CODES) - of_a_run
    for name in Check:
        assert not term(name).startswith("`")


# GitHub


def test_github_commands() -> None:
    lines = written("github", kind()).splitlines()
    axis = next(line for line in lines if "3B204" in line)
    head = f"::error file=dir/part 1.3b,line=2,endLine=2,col=15,endColumn=17,title=3B204 {texts(AXIS).title}::block 2: "
    assert axis.startswith(head)
    assert f"%0Ahint: {texts(AXIS).hint}" in axis
    assert sum(line.startswith("::warning file=halt.3b,title=incomplete::") for line in lines) == 1
    assert not lines[-1].startswith("::")


def test_nothing_escapes_from_a_github_command() -> None:
    *commands, summary = written("github", hostile()).split("\n")[:-1]
    assert len(commands) == 8
    for line in commands:
        _, kind_and_properties, text = line.split("::", 2)
        assert kind_and_properties.split(" ")[0] in {"error", "warning", "notice"}
        assert all("=" in part for part in kind_and_properties.split(" ", 1)[1].split(","))
        assert "%0D" not in text
    assert summary.startswith("5 files: ")
    assert "file=%3A%3Aerror%3A%3Aa%2Cb%3Ac%25.3b" in "".join(commands)


def test_github_says_what_is_not_shown_in_a_command_and_names_the_settings() -> None:
    *_, notice, summary = written("github", quieted()).splitlines()
    assert notice.startswith("::notice title=11 not shown::not shown: 1 by options, 2 by settings (shop/drycut.toml), ")
    assert summary == "3 files: 2 pass, 1 fail; 1 error, 11 not shown"
    assert "settings: shop/drycut.toml\n1 file: 1 fail; 1 error\n" in written("github", quieted()[1:2])


# GitLab


def test_gitlab_places_and_severities() -> None:
    issues = load("gitlab", kind())
    assert [(issue["check_name"], issue["severity"]) for issue in issues] == [
        ("3B205", "minor"),
        ("3B204", "major"),
        ("3B102", "info"),
        ("check-crossings", "minor"),
        ("check-crossings", "minor"),
    ]
    assert issues[1]["location"] == {"path": "dir/part 1.3b", "lines": {"begin": 2}}
    assert issues[2]["location"]["lines"] == {"begin": 1}
    assert issues[1]["description"] == f"block 2: {texts(AXIS).message}"


def test_gitlab_fingerprints_are_unique_and_stay_when_lines_are_put_in_above() -> None:
    moved = AXIS._replace(line=9, block=5, span=(80, 82))
    several = [result(name, AXIS, moved, excerpts={2: COUNTED, 9: COUNTED}) for name in ("a.3b", "b.3b")]
    known = [issue["fingerprint"] for issue in load("gitlab", several)]
    assert len(set(known)) == 4
    (alone,) = load("gitlab", [result("a.3b", moved, excerpts={9: COUNTED})])
    assert alone["fingerprint"] == known[0]
    every = [issue["fingerprint"] for results in (kind(), hostile()) for issue in load("gitlab", results)]
    assert len(set(every)) == len(every)


def test_gitlab_paths_begin_at_the_folder_of_the_job(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    names = [str(tmp_path / "cut" / "a.3b"), "./cut/b.3b", "cut/c.3b"]
    paths = [issue["location"]["path"] for issue in load("gitlab", [result(name, AXIS) for name in names])]
    assert paths == ["cut/a.3b", "cut/b.3b", "cut/c.3b"]


# Concise


def test_concise_is_a_line_a_finding() -> None:
    assert written("concise", kind()).splitlines() == [
        "dir/part 1.3b:1: warning[3B205]: block 1: " + texts(kind()[1].findings[0]).found,
        "dir/part 1.3b:2:15: error[3B204]: [*] block 2: " + texts(AXIS).found,
        "dir/part 1.3b: note[3B102]: " + texts(Finding("3B102")).found,
        f"dir/part 1.3b: incomplete: {term('check-crossings')}: {term('reason-many')}",
        f"halt.3b: incomplete: {term('check-crossings')}: {term('reason-many')}",
        "3 files: 1 pass, 1 fail, 1 incomplete; 1 error, 1 warning, 1 note",
        "[*] 1 can be mended with --fix",
    ]


def test_concise_and_text_are_found_by_one_pattern() -> None:
    pattern = re.compile(
        r"^(.+?):(?:(\d+):)?(?:(\d+):)? (error|warning|note)\[((?:3B|[A-Z]{2,8})\d{3})\]: (.+)$", re.MULTILINE
    )
    found = [pattern.findall(written(name, kind())) for name in ("text", "concise")]
    assert [[match[:5] for match in matches] for matches in found] == [
        [
            ("dir/part 1.3b", "1", "", "warning", "3B205"),
            ("dir/part 1.3b", "2", "15", "error", "3B204"),
            ("dir/part 1.3b", "", "", "note", "3B102"),
        ]
    ] * 2


def test_concise_names_the_settings_and_what_is_not_shown() -> None:
    assert written("concise", quieted()).splitlines()[-1] == (
        "not shown: 1 by options, 2 by settings (shop/drycut.toml), 3 by remarks in the program, 5 in the baseline"
    )
    assert written("concise", quieted()[1:2]).splitlines()[-1] == "settings: shop/drycut.toml"


# What is not shown, in formats for programs


def test_json_names_the_settings_and_what_is_not_shown() -> None:
    value = load("json", quieted())
    assert [file["settings_file"] for file in value["files"]] == ["shop/drycut.toml", "shop/drycut.toml", None]
    assert value["files"][0]["silenced"] == {"options": 1, "settings": 2, "remarks": 3, "baseline": 4, "checks": 0}
    assert value["totals"]["silenced"] == {"options": 1, "settings": 2, "remarks": 3, "baseline": 5, "checks": 0}


def test_sarif_names_the_settings_and_what_is_not_shown() -> None:
    run = load("sarif", quieted())["runs"][0]
    assert run["artifacts"][0]["properties"] == {
        "settingsFile": "shop/drycut.toml",
        "silenced": {"options": 1, "settings": 2, "remarks": 3, "baseline": 4, "checks": 0},
    }
    assert [artifact["roles"] for artifact in run["artifacts"]][2:] == [
        ["analysisTarget"],
        ["userSpecifiedConfiguration"],
    ]
    assert run["artifacts"][3]["location"]["uri"] == "shop/drycut.toml"
    notices = run["invocations"][0]["toolExecutionNotifications"]
    assert [notice["descriptor"]["id"] for notice in notices] == ["findings-not-shown"] * 2
    assert notices[0]["message"]["text"].startswith("not shown: 1 by options, 2 by settings (shop/drycut.toml)")
    assert "properties" not in load("sarif", kind())["runs"][0]["artifacts"][0]


def test_junit_names_the_settings_and_what_is_not_shown() -> None:
    suite = parsed(written("junit", quieted()))[0]
    properties = {entry.get("name"): entry.get("value") for entry in suite.iter("property")}
    assert properties["settings"] == "shop/drycut.toml"
    assert [properties[f"silenced.{by}"] for by in ("options", "settings", "remarks", "baseline")] == list("1234")
    assert suite.findtext("system-out", "").startswith("not shown: 1 by options")


# Places, and how light the formats are


def test_a_place_ends_with_its_line() -> None:
    assert spot(AXIS, {2: COUNTED}) == (2, 15, 17)
    assert spot(AXIS._replace(span=(22, 99)), {2: COUNTED}) == (2, 15, len(COUNTED) + 1)
    assert spot(AXIS._replace(span=(22, 99)), {}) == (2, 15, 92)
    assert spot(Finding("3B102"), {}) == (0, 0, 0)


def test_the_text_format_is_light() -> None:
    code = "import sys, sim.show.findings.text; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True)
    assert not {"rich", "json", "xml", "hashlib"} & set(done.stdout.split())


def test_hostile_text_is_hostile() -> None:
    assert {"\x1b", "\0", "\n", "\r", "\ud800", "\u2028"} < set(HOSTILE)
