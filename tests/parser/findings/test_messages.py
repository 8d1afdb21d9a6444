"""Messages: each that the code says has its text in both languages, and no name of a user is translated in any."""

import ast
import errno
import os
import pickle
import re
from collections.abc import Iterator
from functools import cache
from string import Formatter

import pytest
from trees import trees

from parser.findings.catalogue import Bilingual, message_templates, term
from parser.findings.errors import DrawingError, FileUnreadableError, Message, SettingsError, in_both, system_message

CODES = sorted(message_templates())
CHINESE = re.compile(r"[\u4e00-\u9fff\uff08-\uff1a]")
"""Characters, and the punctuation that stands round a part."""
NAMES = ("part", "slug", "wire", "kerf", "length", "speed", "Is a directory", "the program", "a folder", "输出")
"""Words and phrases of ours that people may name a file, a folder or a layer by."""
OF_TEXTS = {"in-line", "in-file", "of-a-finding", "quoted"}
"""Codes whose texts have no words of their own."""


def places(template: str) -> dict[str, tuple[str, str]]:
    """Places of a template with their conversion and format, in order."""
    return {name: (form or "", how or "") for _, name, form, how in Formatter().parse(template) if name}


def nodes(*folder: str) -> Iterator[tuple[str, ast.AST]]:
    """All nodes of the code in a folder, each with the path of its module."""
    for path, tree in trees().items():
        if path.parts[: len(folder)] == folder:
            yield from ((str(path), node) for node in ast.walk(tree))


@cache
def calls() -> tuple[tuple[str, ast.Call], ...]:
    """Each call of the code whose first argument is the code of a message that is written out."""
    return tuple(
        (f"{path}:{node.lineno}", node)
        for path, node in nodes()
        if isinstance(node, ast.Call) and node.args and _says(node.func)
    )


def _says(function: ast.expr) -> bool:
    name = getattr(function, "id", getattr(function, "attr", ""))
    return name in {"Message", "Damaged"} or (name.endswith("Error") and name in RAISED)


RAISED = {
    "SettingsError",
    "FileUnreadableError",
    "ControllerError",
    "DrawingError",
    "ClusterError",
    "OutputError",
    "CompilerError",
    "PortError",
    "StartError",
    "CardLogError",
}


def test_each_call_gives_the_values_that_the_text_has_places_for() -> None:
    written = [(place, node) for place, node in calls() if isinstance(node.args[0], ast.Constant)]
    assert len(written) > 200
    for place, node in written:
        code = node.args[0].value  # type: ignore[attr-defined]  # a constant, see above
        given = {keyword.arg for keyword in node.keywords}
        assert code in message_templates(), place
        assert given == set(places(message_templates()[code].en)), place


def test_no_sentence_is_raised() -> None:
    for place, node in calls():
        assert not isinstance(node.args[0], ast.JoinedStr), place
    for path, node in nodes("sim", "cli"):
        name = getattr(getattr(node, "func", None), "attr", "")
        if name in {"UsageError", "BadParameter", "fail"} and isinstance(node, ast.Call):
            assert not isinstance(node.args[0], ast.JoinedStr | ast.Constant), (path, node.lineno)


def test_no_text_is_there_that_nothing_says() -> None:
    said = {node.value for _, node in nodes() if isinstance(node, ast.Constant) and isinstance(node.value, str)}
    assert set(CODES) - said == set()


def test_both_languages_have_the_same_places() -> None:
    for code, of in message_templates().items():
        assert places(of.en) == places(of.zh), code
        assert code in OF_TEXTS or CHINESE.search(of.zh), code


@pytest.mark.parametrize("name", NAMES)
def test_no_name_of_a_user_is_translated(name: str) -> None:
    for code, template in message_templates().items():
        of = places(template.en)
        numbers = {place for place, (form, _) in of.items() if form and form not in {"term", "aside"}}
        message = Message(code, **{place: 7 if place in numbers else name for place in of})
        shown = [place for place, (form, _) in of.items() if place not in numbers and form != "term"]
        for text in (message.en, message.zh):
            assert text.count(name) >= len(shown), (code, text)


def test_a_message_within_another_is_in_the_language_of_the_whole() -> None:
    inner = Message("did-you-mean", name="part")
    outer = Message("unknown-key", where="a.toml", key="prat", hint=inner)
    assert outer == outer.en == "a.toml: unknown key 'prat'; did you mean part?"
    assert outer.zh == "a.toml：没有键 'prat'；是不是 part？"
    assert in_both(outer) == Bilingual(outer.en, outer.zh)
    changed = outer.with_values(lambda value: "b.toml" if value == "a.toml" else value)
    assert changed.zh == "b.toml：没有键 'prat'；是不是 part？"


def test_what_is_no_message_is_the_same_in_both() -> None:
    assert in_both("a sentence of some library") == Bilingual(*["a sentence of some library"] * 2)


@pytest.mark.parametrize("error", [SettingsError, DrawingError, FileUnreadableError])
def test_errors_and_their_messages_come_whole_from_another_process(error: type[SettingsError]) -> None:
    raised = error("in-file", file="part", message=Message("drawing-empty", path="wire"))
    again = pickle.loads(pickle.dumps(raised))  # noqa: S301 - made in this test
    assert (type(again), str(again), again.in_both()) == (error, str(raised), raised.in_both())
    assert raised.in_both().zh == "part：wire：空文件；应为 DXF 图纸"


def test_an_error_of_a_message_is_that_message() -> None:
    message = Message("drawing-empty", path="wire")
    assert DrawingError(message).message is message


def test_the_words_of_the_system_are_in_both_languages() -> None:
    assert system_message(OSError(errno.ENOENT, os.strerror(errno.ENOENT))) == os.strerror(errno.ENOENT)
    found = system_message(OSError(errno.EACCES, os.strerror(errno.EACCES)))
    assert in_both(found).zh == "没有权限"
    assert in_both(system_message(ValueError("embedded null byte"))).zh == "名字中有空字符"
    odd = os.strerror(errno.EDOM)
    assert in_both(system_message(OSError(errno.EDOM, odd))) == Bilingual(odd, odd)


def test_why_a_file_cannot_be_read_is_a_term_in_both() -> None:
    error = FileUnreadableError("cannot-be-read-since", file="big.3b", what="file-too-large", detail="LIMIT=1")
    assert error.in_both().en == f"big.3b: cannot be read: {term('file-too-large')} (LIMIT=1)"
    assert error.in_both().zh == f"big.3b：无法读取：{term('file-too-large', 'zh')}（LIMIT=1）"
    assert (error.what, error.detail) == ("file-too-large", "LIMIT=1")
