"""What the documents say of the codes.

docs/findings.md and docs/findings.zh.md are made from the pages of the catalogue. In the table of checks of
docs/check.md the codes of each check are renewed, and in README.md how many codes there are.
"""

import re
from collections.abc import Mapping
from pathlib import Path

from parser.findings.catalogue import Language, page
from parser.findings.codes import CODES
from sim.check.pages import layers, page_text, page_title, severity_word

NAMES: Mapping[Language, str] = {"en": "findings.md", "zh": "findings.zh.md"}

_INTRODUCTIONS: Mapping[Language, str] = {
    "en": """\
# Findings

<!-- Made from the pages in parser/findings/pages: change those, then `make pages`. -->

[中文](findings.zh.md)

A finding is one thing that is wrong with a program: a stable code, a severity, the place, and texts that say what was
found, what was expected, what the machine would do, and how to mend it.

```
part.3b:2:14: error[3B204]: block 2: the block counts on X, and its steps end 140.00 µm from its exact end; …
  2 | B9900B0B39600GXNR1
    |              ^^
    = hint: write GY, with J 39600
```

`part.3b:2:14` is line 2, column 14. `drycut check` ([check.md](check.md)) prints all findings; `drycut run` prints at
most 20 under its summary and writes all of them into `report.json` ([report.md](report.md)). `drycut explain 3B204`
shows the page of a code, `--lang zh` in Chinese.

An **error** is certain to spoil a part or a machine: the verdict is `fail`, the exit code 1. A **warning** may be meant
so; it makes the exit code of a check 1 only with `--fail-on warning`. A **note** is worth knowing. With 3B100 the exit
code is 2; with 3B206 that of `drycut run` is.

The hundreds digit names the layer. Of each example, `drycut check` says what its page says, and of the mended one
nothing but notes.
""",
    "zh": """\
# 检查结果代码

<!-- 由 parser/findings/pages 生成：改那里的文件，再运行 make pages。 -->

[English](findings.md)

每条结果指出程序的一处问题：固定的代码、级别、位置，并说明发现了什么、应该是什么、机床会怎样、如何改正。

```
part.3b:2:14: 错误[3B204]: 第 2 段：本段按 X 计数，走步终点离理论终点 140.00 µm；…
  2 | B9900B0B39600GXNR1
    |              ^^
    = 提示：改为 GY，J 写 39600
```

`part.3b:2:14` 是第 2 行第 14 列。`drycut check`（[check.md](check.md)，英文）给出全部结果；`drycut run` 在摘要下
最多显示 20 条，全部写入 `report.json`（[report.md](report.md)，英文）。`drycut explain 3B204 --lang zh` 显示
一个代码的说明。

**错误**肯定会废掉零件或损伤机床：结论为不通过，退出码 1。**警告**可能是有意的，只有用 `--fail-on warning` 时检查的
退出码才是 1。**说明**供参考。有 3B100 时退出码为 2；`drycut run` 遇到 3B206 也是 2。

代码的百位数表示所属层次。各页示例用 `drycut check` 检查，得到的就是该页所说的结果；改正后的程序最多只有说明。
""",
}
_PATH = re.compile(r"docs/(\w+\.md)")
_CHECK_ROW = re.compile(r"^(\| `(check-[\w-]+)` \|[^|]*\| )[^|]*( \|)", re.MULTILINE)
_COUNT = re.compile(r"There are \d+ codes")
_HEADS: Mapping[Language, tuple[str, ...]] = {
    "en": ("code", "severity", "title", "中文"),
    "zh": ("代码", "级别", "名称", "English"),
}


def findings_document(language: Language) -> str:
    """The whole document: what findings are, and by layer a table of the codes and their pages."""
    parts = [_INTRODUCTIONS[language]]
    for title, codes in layers(language):
        parts += [f"## {title}\n", _table(codes, language)]
        parts += [page_text(code, language, level=3) for code in codes]
    return _PATH.sub(r"[\1](\1)", "\n".join(parts))


def anchor(heading: str) -> str:
    """Anchor that GitHub gives a heading."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", "-")


def _table(codes: tuple[str, ...], language: Language) -> str:
    other: Language = "en" if language == "zh" else "zh"
    rows = []
    for code in codes:
        link = f"[{code}](#{anchor(page_title(code, language))})"
        rows.append((link, severity_word(code, language), page(code, language).title, page(code, other).title))
    head, *lines = (f"| {' | '.join(row)} |\n" for row in (_HEADS[language], *rows))
    return "".join([head, "|---" * len(_HEADS[language]) + "|\n", *lines])


def documents(root: Path) -> dict[Path, str]:
    """Every document of a folder of the project that tells of the codes, as it should be."""
    check, readme = root / "docs" / "check.md", root / "README.md"
    return {
        **{root / "docs" / name: findings_document(language) for language, name in NAMES.items()},
        check: _CHECK_ROW.sub(_check_row, check.read_text(encoding="utf-8")),
        readme: _COUNT.sub(f"There are {len(CODES)} codes", readme.read_text(encoding="utf-8")),
    }


def _check_row(row: re.Match[str]) -> str:
    begin, check, end = row.groups()
    return begin + ", ".join(code for code, of in CODES.items() if of.check == check) + end


if __name__ == "__main__":
    for path, text in documents(Path()).items():
        path.write_text(text, encoding="utf-8", newline="\n")
