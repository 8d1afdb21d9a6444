"""Pages of the catalogue as Markdown, for ``drycut explain`` and for the findings documents."""

from parser.findings.catalogue import Language, example, page
from parser.findings.codes import CODES, Severity

_WORDS: dict[Language, dict[str, str]] = {
    "en": {
        "error": "error",
        "warning": "warning",
        "note": "note",
        "title": "{code}: {title} ({severity})",
        "mend": "**How to mend it:**",
        "example": "**Example:**",
        "example with": "**Example** (checked with `{options}`):",
        "mended": "**Mended:**",
        "layer 1": "Grammar",
        "layer 2": "Block",
        "layer 3": "Contour",
        "layer 4": "Machine and scenario",
        "layer 5": "Wire offset",
        "layer 6": "Drawing",
    },
    "zh": {
        "error": "错误",
        "warning": "警告",
        "note": "说明",
        "title": "{code}：{title}（{severity}）",
        "mend": "**如何改正：**",
        "example": "**示例：**",
        "example with": "**示例**（检查选项 `{options}`）：",
        "mended": "**改正后：**",
        "layer 1": "文件",
        "layer 2": "程序段",
        "layer 3": "轮廓",
        "layer 4": "机床与 scenario",
        "layer 5": "间隙补偿",
        "layer 6": "图纸",
    },
}


def page_text(code: str, language: Language, level: int = 1) -> str:
    """Page of a code as Markdown, its title a heading of this level. KeyError where there is no such code."""
    of, words = page(code, language), _WORDS[language]
    parts = [f"{'#' * level} {page_title(code, language)}", of.why.strip(), f"{words['mend']}\n{of.mend.strip()}"]
    shown = example(code)
    if shown:
        head = words["example with"].format(options=" ".join(shown.options)) if shown.options else words["example"]
        parts += [f"{head}\n{_fenced(shown.program)}", f"{words['mended']}\n{_fenced(shown.mended)}"]
    return "\n\n".join(parts) + "\n"


def page_title(code: str, language: Language) -> str:
    """``3B204: wrong count axis (error)``."""
    title, severity = page(code, language).title, severity_word(code, language)
    return _WORDS[language]["title"].format(code=code, title=title, severity=severity)


def titles_text(language: Language) -> str:
    """Every code with its severity and title, one a line, by layer."""
    return "\n".join(
        "".join([f"{title}\n", *(f"  {_title_line(code, language)}\n" for code in codes)])
        for title, codes in layers(language)
    )


def layers(language: Language) -> tuple[tuple[str, tuple[str, ...]], ...]:
    """Titles of the layers, each with its codes."""
    digits = sorted({code[2] for code in CODES})
    return tuple(
        (_WORDS[language][f"layer {digit}"], tuple(code for code in sorted(CODES) if code[2] == digit))
        for digit in digits
    )


def severity_word(code: str, language: Language) -> str:
    """Severity of a code, for people."""
    return _WORDS[language][CODES[code].severity]


def _title_line(code: str, language: Language) -> str:
    width = max(len(_WORDS[language][severity]) for severity in Severity)
    return f"{code}  {severity_word(code, language):{width}}  {page(code, language).title}"


def _fenced(program: str) -> str:
    return f"```\n{program.strip()}\n```"
