"""Sentences of the formats in English and Chinese; names of checks and reasons are terms of the catalogue."""

from collections.abc import Iterable, Mapping
from types import MappingProxyType

from parser.findings.catalogue import Language, term, texts
from parser.findings.codes import Severity
from parser.findings.findings import Finding
from sim.check.result import CheckResult, CheckState, State
from sim.show.findings.totals import Totals

_EN = {
    "pass": "pass",
    "fail": "fail",
    "incomplete": "incomplete",
    "error": "error",
    "warning": "warning",
    "note": "note",
    "hint": "hint",
    "block": "block {block}: {message}",
    "blocks": "{read} of {found} blocks read, {decoded} decoded, {stepped} stepped",
    "complete checks": "{n} complete",
    "incomplete checks": "{n} incomplete",
    "not asked checks": "{n} not asked",
    "checks": "checks: {states}",
    "reason": "{check}: {reason}",
    "why": " ({reasons})",
    "counted": "{n} {word}",
    "files": "{n} files: {verdicts}; {findings}",
    "no findings": "no findings",
    "comma": ", ",
    "stop": "; ",
    "colon": ": ",
    "code": "code",
    "severity": "severity",
    "count": "count",
    "title": "title",
    "total files": "files",
    "total blocks": "blocks",
    "total steps": "steps",
    "total length": "path length",
}
_ZH = {
    "pass": "通过",
    "fail": "不通过",
    "incomplete": "未查完",
    "error": "错误",
    "warning": "警告",
    "note": "说明",
    "hint": "提示",
    "block": "第 {block} 段：{message}",
    "blocks": "共 {found} 段，读入 {read} 段，解码 {decoded} 段，走步 {stepped} 段",
    "complete checks": "{n} 项查完",
    "incomplete checks": "{n} 项未查完",
    "not asked checks": "{n} 项未要求",
    "checks": "检查：{states}",
    "reason": "{check}：{reason}",
    "why": "（{reasons}）",
    "counted": "{n} 个{word}",
    "files": "{n} 个文件：{verdicts}；{findings}",
    "no findings": "没有发现问题",
    "comma": "，",
    "stop": "；",
    "colon": "：",
    "code": "代码",
    "severity": "级别",
    "count": "个数",
    "title": "名称",
    "total files": "文件",
    "total blocks": "段数",
    "total steps": "步数",
    "total length": "路径长度",
}
_WORDS: Mapping[Language, Mapping[str, str]] = MappingProxyType({"en": _EN, "zh": _ZH})
_STATES: tuple[State, ...] = ("complete", "incomplete", "not asked")


def word(key: str, language: Language) -> str:
    """A word or a template of the formats' own."""
    return _WORDS[language][key]


def message(finding: Finding, language: Language) -> str:
    """What a finding says, with its block before it."""
    text = texts(finding, language).message
    return word("block", language).format(block=finding.block, message=text) if finding.block else text


def with_hint(finding: Finding, language: Language) -> str:
    """What a finding says, and in a second line how to mend it."""
    hint = texts(finding, language).hint
    text = message(finding, language)
    return f"{text}\n{word('hint', language)}{word('colon', language)}{hint}" if hint else text


def reason(check: CheckState, language: Language) -> str:
    """Name of a check, and why it is not complete."""
    return word("reason", language).format(check=term(check.name, language), reason=term(check.reason, language))


def findings(counts: Mapping[Severity, int], language: Language) -> str:
    """``2 errors, 1 warning``; empty where there is none."""
    parts = (_counted(count, severity, language) for severity, count in counts.items() if count)
    return word("comma", language).join(parts)


def coverage(result: CheckResult, language: Language) -> str:
    """``fail: 2 errors, 1 warning; 6 of 7 blocks read, …; checks: 9 complete, …``."""
    found = findings({severity: result.count(severity) for severity in Severity}, language)
    verdict = word(result.verdict, language)
    parts = (
        f"{verdict}{word('colon', language)}{found}" if found else verdict,
        word("blocks", language).format(**result.coverage._asdict()),
        word("checks", language).format(states=_states(result.coverage.checks, language)),
    )
    return word("stop", language).join(parts)


def summary(totals: Totals, language: Language) -> str:
    """``3 files: 1 pass, 2 fail; 2 errors``."""
    return word("files", language).format(
        n=totals.files.total(),
        verdicts=verdicts(totals, language),
        findings=findings(totals.by_severity(), language) or word("no findings", language),
    )


def verdicts(totals: Totals, language: Language) -> str:
    """``1 pass, 2 fail``: files by verdict, those there are."""
    parts = (f"{count} {word(verdict, language)}" for verdict, count in totals.by_verdict().items() if count)
    return word("comma", language).join(parts)


def _states(checks: tuple[CheckState, ...], language: Language) -> str:
    by_state = {state: [check for check in checks if check.state == state] for state in _STATES}
    parts = (_state(state, of, language) for state, of in by_state.items() if of or state == "complete")
    return word("comma", language).join(parts)


def _state(state: State, checks: list[CheckState], language: Language) -> str:
    text = word(f"{state} checks", language).format(n=len(checks))
    if state == "complete":
        return text
    if state == "incomplete":
        why = word("stop", language).join(reasons(checks, language))
    else:  # what was not asked for, its name says why
        why = word("comma", language).join(term(check.name, language) for check in checks)
    return text + word("why", language).format(reasons=why)


def reasons(checks: Iterable[CheckState], language: Language) -> list[str]:
    """Why checks are incomplete: their names before the reason that they share."""
    names: dict[str, list[str]] = {}
    for check in checks:
        if check.state == "incomplete":
            names.setdefault(check.reason, []).append(term(check.name, language))
    template, comma = word("reason", language), word("comma", language)
    return [template.format(check=comma.join(of), reason=term(why, language)) for why, of in names.items()]


def _counted(count: int, severity: Severity, language: Language) -> str:
    plural = "s" if language == "en" and count != 1 else ""
    return word("counted", language).format(n=count, word=word(severity, language) + plural)
