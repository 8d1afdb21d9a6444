"""The modules of a page joined into one script: in the order of their imports, each with names of its own."""

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from browser import OpenPage
from places import ROOT

from sim.show.html.environment import joined

ASSETS = ROOT / "sim" / "show"
Written = Callable[..., Path]


@pytest.fixture
def written(tmp_path: Path) -> Written:
    """Writes modules by name, and gives the path of the one called main."""

    def write(**modules: str) -> Path:
        for name, text in modules.items():
            (tmp_path / f"{name}.js").write_text(text, "utf-8")
        return tmp_path / "main.js"

    return write


def value(open_page: OpenPage, entry: Path) -> object:
    """What an entry module exports, as a page in a browser has it."""
    page = open_page(f"<!doctype html><html lang=en><title>t</title><script>const made = {joined(entry)};</script>")
    return page.page.evaluate("made")


def test_modules_run_once_each_after_those_they_import(open_page: OpenPage, written: Written) -> None:
    log = "window.ran = [...(window.ran ?? []), NAME];\n"
    entry = written(
        main='import { b } from "./b.js";\nimport { c } from "./c.js";\n'
        "export const made = { b, c, ran: window.ran };\n",
        b='import { c } from "./c.js";\n' + log.replace("NAME", '"b"') + "export const b = `b${c}`;\n",
        c=log.replace("NAME", '"c"') + 'export const c = "c";\n',
    )
    assert value(open_page, entry) == {"made": {"b": "bc", "c": "c", "ran": ["c", "b"]}}


def test_names_that_are_not_exported_are_a_modules_own(open_page: OpenPage, written: Written) -> None:
    entry = written(
        main='import { one } from "./one.js";\nimport * as two from "./two.js";\n'
        "const size = 3;\nexport const sizes = [one(), two.count(), size];\n",
        one="const size = 1;\nexport function one() { return size; }\n",
        two="let size = 2;\nfunction one() { return size; }\nexport function count() { return one(); }\n",
    )
    assert value(open_page, entry) == {"sizes": [1, 2, 3]}


def test_every_form_of_import_and_export_is_kept(open_page: OpenPage, written: Written) -> None:
    entry = written(
        main='import {\n  CONSTANT,\n  Kind as Other,\n  later,\n} from "./forms.js";\n'
        "export const made = [CONSTANT, new Other().name, typeof later];\nexport function unused() {}\n",
        forms='export const CONSTANT = 1;\nexport class Kind { name = "kind"; }\nexport async function later() {}\n',
    )
    script = f"const {{ made }} = {joined(entry)};"
    page = open_page(f"<!doctype html><html lang=en><title>t</title><script>{script}</script>").page
    assert page.evaluate("made") == [1, "kind", "function"]


def test_doc_comments_on_lines_of_their_own_are_left_out_and_no_code(open_page: OpenPage, written: Written) -> None:
    entry = written(
        main="// Kept.\n/** @typedef {1} One */\n/** @type {One} */ const a = 1;\n/**\n * Gone.\n * @type {One}\n */\n"
        "const b = /** @type {One} */ (a); /* kept */\n  /** Gone. */\nexport const both = [a, b];\n"
    )
    assert re.findall(r"/\*.*?\*/", joined(entry)) == ["/** @type {One} */", "/** @type {One} */", "/* kept */"]
    assert "// Kept." in joined(entry)
    assert value(open_page, entry) == {"both": [1, 1]}


def test_modules_of_other_folders_are_found_and_may_have_the_same_name(open_page: OpenPage, tmp_path: Path) -> None:
    for folder in ("own", "shared"):
        (tmp_path / folder).mkdir()
    (tmp_path / "own" / "main.js").write_text(
        'import { words as own } from "./words.js";\nimport { words } from "../shared/words.js";\n'
        "export const all = [own, words];\n",
        "utf-8",
    )
    (tmp_path / "own" / "words.js").write_text('export const words = "own";\n', "utf-8")
    (tmp_path / "shared" / "words.js").write_text('export const words = "shared";\n', "utf-8")
    assert value(open_page, tmp_path / "own" / "main.js") == {"all": ["own", "shared"]}


@pytest.mark.parametrize(
    ("modules", "complaint"),
    [
        (
            {
                "main": 'import { a } from "./a.js";',
                "a": 'import { b } from "./b.js";\nexport const a = b;',
                "b": 'import { a } from "./a.js";\nexport const b = a;',
            },
            "modules import each other in a circle: a.js -> b.js -> a.js",
        ),
        ({"main": 'import { me } from "./main.js";\nexport const me = 1;'}, "in a circle: main.js -> main.js"),
        ({"main": 'import { gone } from "./gone.js";'}, "main.js imports gone.js, which is not there"),
        (
            {"main": 'import { own } from "./a.js";', "a": "const own = 1;\nexport const other = own;"},
            "main.js imports own, which a.js does not export",
        ),
        (
            {"main": 'import { here as own } from "./a.js";', "a": "export const own = 1;"},
            "main.js imports here, which a.js does not export",
        ),
        ({"main": "export default 1;"}, "main.js: cannot be joined: export default 1;"),
        ({"main": "export let count = 1;"}, "main.js: cannot be joined: export let count = 1;"),
        ({"main": 'import "./a.js";', "a": ""}, 'main.js: cannot be joined: import "./a.js";'),
        ({"main": 'const end = "</Script>";'}, "main.js: </Script would end the script of a page"),
    ],
)
def test_what_cannot_be_joined_is_an_error_that_names_the_module(
    written: Written, modules: dict[str, str], complaint: str
) -> None:
    with pytest.raises(ValueError, match=re.escape(complaint)):
        joined(written(**modules))


def test_the_same_modules_give_the_same_text_and_are_joined_once(written: Written, tmp_path: Path) -> None:
    modules = {"main": 'import { a } from "./a.js";\nexport const b = a;\n', "a": "export const a = 1;\n"}
    first = joined(written(**modules))
    assert joined(tmp_path / "main.js") is first
    joined.cache_clear()
    assert joined(tmp_path / "main.js") == first
    assert str(tmp_path) not in first


def pages() -> list[Path]:
    """The folders of all pages that have scripts of their own."""
    return sorted({module.parent for module in ASSETS.glob("*/assets/*.js")} - {ASSETS / "html" / "assets"})


def templates(folder: Path) -> str:
    """The text of all templates of a page."""
    return "".join(file.read_text("utf-8") for file in sorted(folder.glob("*.j2")))


def scripts(folder: Path) -> str:
    """All scripts of a page, joined as its templates have them."""
    entries = re.findall(r'joined\("([\w./]+)"', templates(folder))
    return "".join(joined(folder / name) for name in entries)


@pytest.mark.parametrize("folder", pages(), ids=lambda folder: folder.parent.name)
def test_every_module_of_a_page_is_in_its_script(folder: Path) -> None:
    template, script = templates(folder), scripts(folder)
    for module in folder.glob("*.js"):
        alone = f'inlined("{module.name}")' in template
        assert alone or module.read_text("utf-8").partition("\n")[0] in script, module


def test_every_module_for_all_pages_is_in_two_or_more() -> None:
    folders = [file.parent for file in ASSETS.glob("*/assets/*.j2")]
    texts = {folder: templates(folder) + scripts(folder) for folder in folders if folder != ASSETS / "html" / "assets"}
    for module in (ASSETS / "html" / "assets").glob("*.js"):
        marks = (f'inlined("{module.name}")', module.read_text("utf-8").partition("\n")[0])
        assert sum(any(mark in text for mark in marks) for text in texts.values()) > 1, module
