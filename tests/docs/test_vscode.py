"""The extension for VS Code: what its manifest names is there, in both languages."""

import json
import re

from places import ROOT

from parser import __version__

FOLDER = ROOT / "docs" / "vscode"
MANIFEST = json.loads((FOLDER / "package.json").read_text("utf-8"))


def test_it_has_the_version_of_drycut() -> None:
    assert MANIFEST["version"] == __version__


def test_every_text_of_it_stands_in_both_languages() -> None:
    named = set(re.findall(r'"%(\w+)%"', (FOLDER / "package.json").read_text("utf-8")))
    for file in ("package.nls.json", "package.nls.zh-cn.json"):
        assert set(json.loads((FOLDER / file).read_text("utf-8"))) == named


def test_every_language_has_a_grammar_and_what_else_it_names() -> None:
    of = MANIFEST["contributes"]
    grammars = {grammar["language"]: grammar for grammar in of["grammars"]}
    for language in of["languages"]:
        grammar = json.loads((FOLDER / grammars[language["id"]]["path"]).read_text("utf-8"))
        assert grammar["scopeName"] == grammars[language["id"]]["scopeName"]
        assert (FOLDER / language["configuration"]).exists()
    for command in of["commands"]:
        assert command["command"] in (FOLDER / "src" / "extension.js").read_text("utf-8")
