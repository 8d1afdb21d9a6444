"""The page of a lesson in a browser: it marks as `drycut class mark` does, and anyone can do a lesson on it."""

import json
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from axe import needs_axe, violations
from browser import OpenPage
from depth import cases
from page_checks import complaints
from sittings import hand_in_of, page, ready, right_answer, text_of

from parser.program import parse_program
from sim.jobs.class_marks import marking_of
from sim.jobs.lessons import lesson_names
from sim.show.html.environment import joined
from sim.show.lesson_page.page import lesson_entry
from sim.teach.handins import HandIn, read_hand_in
from sim.teach.marking import marked
from sim.teach.plain.tasks import seed_of_task

if TYPE_CHECKING:
    from playwright.sync_api import Locator, Page

ASSETS = Path(__file__).parents[2] / "sim" / "show" / "lesson_page" / "assets"
HEAD = '<!doctype html><html lang="en"><title>x</title><meta charset="utf-8">'
BARE = HEAD + "<script>const {name} = {module};</script>"
SENSES = {0: "L", 1: "NR", -1: "SR"}
ENDS = "text => program.written_of(text, { x: 0, y: 0 }).curves.map(({ end }) => [end.x, end.y])"
TEXTS = 200
MOST_BYTES = 1_000_000
FIRST_PICTURE_MS = 1000
FIRST_PICTURE = """() => {
  const loaded = performance.getEntriesByType("navigation")[0].domContentLoadedEventEnd;
  const begin = performance.now();
  document.querySelector("#name").value = "Li";
  document.querySelector("#class").value = "1";
  document.querySelector("#start").requestSubmit();
  const form = document.querySelector("form.step:not(.aside-now)");
  if (!form.querySelector(".picture path").getAttribute("d")) throw new Error("there is no picture");
  return loaded + performance.now() - begin;
}"""
"""Time to load the page, and from its start to its first picture, ms."""


def with_module(open_page: OpenPage, file: str, name: str) -> "Page":
    """A page that holds what a module of the lesson exports."""
    html = BARE.replace("{name}", name).replace("{module}", joined(ASSETS / file))
    return open_page(html).page


def random_text(chance: Random) -> str:
    """A program of blocks of any kind."""
    lines = []
    for _ in range(TEXTS):
        size = chance.choice((3, 50, 1000, 40_000))
        x, y = chance.choice((0, chance.randint(0, size))), chance.randint(0, size)
        count = chance.choice((0, max(x, y), chance.randint(0, 5 * size)))
        sense = chance.choice(("L", "NR", "SR"))
        lines.append(f"B{x} B{y} B{count} G{chance.choice('XY')} {sense}{chance.randint(1, 4)}")
    return "\n".join(lines)


@pytest.mark.deep
def test_the_page_decodes_as_the_parser_does(open_page: OpenPage) -> None:
    shown = with_module(open_page, "plain_program.js", "program")
    for seed in cases(25, 5000):  # of 200 blocks
        text = random_text(Random(seed))
        found = shown.evaluate(ENDS, text)
        path = parse_program(text, "part.3b").toolpath

        assert np.abs(np.array(found) - path.end_um).max() < 1e-5, seed


def read(hand_in: dict[str, Any], name: str) -> HandIn:
    lesson = ready(name)
    return read_hand_in(
        text_of(hand_in), lesson_entry(lesson)["lesson"], tuple(e.rules.tasks for e in lesson.exercises)
    )


@pytest.mark.deep
@pytest.mark.parametrize("name", lesson_names())
def test_marks_by_the_page_are_those_that_marking_gives(open_page: OpenPage, name: str) -> None:
    shown = with_module(open_page, "sitting.js", "sitting")
    lesson = ready(name)
    entry = json.loads(json.dumps(lesson_entry(lesson)))
    shown.evaluate("lesson => { window.lesson = lesson; }", entry)
    for number in cases(30, 400):
        hand_in = hand_in_of(lesson, f"学生{number}", number % 11 / 10)
        found = shown.evaluate(
            """({ name, group, answers }) => {
                const own = sitting.newSitting(window.lesson, name, group);
                answers.forEach((tasks, at) => tasks.forEach((texts, task) => own.answers[at][task].push(...texts)));
                return own.handIn();
            }""",
            hand_in,
        )
        mark = marked(marking_of(lesson), read(found, name))

        assert found["seed"] == hand_in["seed"]
        assert np.abs(np.array(found["points"]) - np.array(mark.points)).max() < 1e-9, hand_in
        assert (mark.is_changed, mark.is_of_other) == (False, False)


@pytest.mark.parametrize("typed", ["王😀", "Li\u00a0Lei", "王\u200b小", "\u200fعلي", "a\u202eb", "x\ufeffy", "e\u0301"])
def test_the_numbers_of_any_name_are_those_that_marking_chooses(open_page: OpenPage, typed: str) -> None:
    name = "1-first-blocks"
    shown = open_page(page(name)).page
    shown.fill("#name", typed)
    shown.fill("#class", f"{typed}1")
    shown.click("#start button")
    shown.evaluate("document.querySelector('#end').hidden = false")
    with shown.expect_download() as saved:
        shown.locator("#save").click()
    mark = marked(marking_of(ready(name)), read(json.loads(Path(saved.value.path()).read_text("utf-8")), name))

    assert not mark.is_of_other


def begun(open_page: OpenPage, name: str, **how: Any) -> "Page":
    shown = open_page(page(name), **how).page
    shown.fill("#name", "王小明")
    shown.fill("#class", "线切割 1 班")
    shown.click("#start button")
    return shown


def step(page_: "Page") -> "Locator":
    """The task that shows."""
    return page_.locator("form.step:not(.aside-now)")


def test_a_lesson_is_done_by_keyboard_alone_and_handed_in(open_page: OpenPage, tmp_path: Path) -> None:
    name = "1-first-blocks"
    seed = marking_of(ready(name)).seed_of("王小明 线切割 1 班")
    shown = open_page(page(name), lang="zh").page
    shown.keyboard.press("Tab")  # the language
    for text in ("王小明", "线切割 1 班"):
        shown.keyboard.press("Tab")
        shown.keyboard.insert_text(text)
    shown.keyboard.press("Enter")
    for at, exercise in enumerate(ready(name).exercises):
        for task in range(exercise.rules.tasks):
            text = right_answer(ready(name), at, task, seed_of_task(seed, at))
            shown.keyboard.press("Tab")
            if exercise.rules.ask == "next-step":
                shown.keyboard.press("Space")
                for _ in range(int(text)):
                    shown.keyboard.press("ArrowDown")
            else:
                shown.keyboard.insert_text(text)
            if exercise.rules.kind == "program":
                shown.keyboard.press("Tab")  # to the button that checks it
            shown.keyboard.press("Enter")
            shown.keyboard.press("Enter")  # on to the next one
    assert shown.locator("#end").is_visible()
    with shown.expect_download() as saved:
        shown.locator("#save").press("Enter")
    assert saved.value.suggested_filename == "线切割 1 班 王小明.drycut.json"
    saved.value.save_as(tmp_path / "saved.json")
    hand_in = read(json.loads((tmp_path / "saved.json").read_text("utf-8")), name)
    mark = marked(marking_of(ready(name)), hand_in)
    assert (mark.name, mark.is_changed, mark.is_of_other) == ("王小明", False, False)
    assert mark.sum == pytest.approx(100.0)


def test_an_empty_name_is_refused(open_page: OpenPage) -> None:
    shown = open_page(page("1-first-blocks")).page
    for name, group in (("", ""), (" ", "1"), ("Li", "  ")):
        shown.fill("#name", name)
        shown.fill("#class", group)
        shown.evaluate("document.querySelector('#start').noValidate = true")
        shown.click("#start button")
        assert shown.locator("#incomplete").is_visible()
    assert step(shown).count() == 0


def test_a_block_is_drawn_stepped_hinted_and_marked_as_it_is_written(open_page: OpenPage) -> None:
    shown = begun(open_page, "1-first-blocks")
    form = step(shown)
    form.locator(".entry input").fill("B1000 B0 B1000 GX L1")
    assert "M" in form.locator(".picture .path").get_attribute("d")
    assert form.locator(".stepper input").get_attribute("max") == "1000"
    form.locator(".stepper input").fill("250")
    assert "250/1000" in form.locator("output").inner_text() or "250 of 1000" in form.locator("output").inner_text()
    for count in range(1, 6):
        form.locator(".hint").click()
        assert form.locator(".reasons li").count() == count
    assert form.locator(".hint").is_disabled()
    form.locator(".check").click()
    assert form.locator(".words li").count() == 5
    form.locator(".check").click()
    assert form.locator(".check").is_hidden()
    assert "B" in form.locator(".reasons li").last.inner_text()


def test_the_slip_of_a_program_is_told_with_its_place(open_page: OpenPage) -> None:
    shown = begun(open_page, "2-circle-and-quadrant")
    for _ in range(8):
        step(shown).locator(".pass").click()
    form = step(shown)
    form.locator("textarea").fill("B8100B0B8100GXL1\nB8100B0B32400GYNR1\nB8100B0B8100GXL3\nDD")
    form.locator(".check").click()
    wrong = form.locator(".parts li.wrong")
    assert [item.get_attribute("data-part") for item in wrong.all()] == ["offset"]
    assert "0.2 mm" in form.locator(".reasons").inner_text()
    form.locator("textarea").fill("B7900B0B7900GXL1\nB7900B0B31600GYNR1\nB7900B0B7900GXL3\nDD")
    form.locator(".check").click()
    assert form.locator(".parts li.right").count() == 8


LOOKS = [("en", True, 400), ("zh", False, 1280)]


@pytest.mark.alike(1)
@needs_axe
@pytest.mark.parametrize(("lang", "dark", "width"), LOOKS)
@pytest.mark.parametrize("name", lesson_names())
def test_no_step_of_a_lesson_breaks_a_rule(open_page: OpenPage, name: str, lang: str, dark: bool, width: int) -> None:
    shown = begun(open_page, name, lang=lang, dark=dark, width=width)
    tasks = sum(exercise.rules.tasks for exercise in ready(name).exercises)
    kinds = set()
    for _ in range(tasks):
        form = step(shown)
        exercise = ready(name).exercises[int(form.get_attribute("data-exercise"))]
        kind = (exercise.rules.kind, exercise.rules.ask)
        if kind not in kinds:
            kinds.add(kind)
            assert violations(shown) == []
            assert complaints(shown) == []
        form.locator(".pass").click()
    assert violations(shown) == []


@pytest.mark.parametrize("name", lesson_names())
def test_a_page_is_small(name: str) -> None:
    assert len(page(name).encode()) < MOST_BYTES


@pytest.mark.alone
@pytest.mark.parametrize("name", lesson_names())
def test_the_first_picture_is_soon_there_on_a_slow_phone(open_page: OpenPage, name: str) -> None:
    times = []
    for _ in range(3):
        shown = open_page(page(name)).page
        shown.context.new_cdp_session(shown).send("Emulation.setCPUThrottlingRate", {"rate": 4})
        shown.reload()
        times.append(shown.evaluate(FIRST_PICTURE))
    assert min(times) < FIRST_PICTURE_MS, times


def test_printed_it_has_all_tasks_and_no_answer(open_page: OpenPage) -> None:
    shown = open_page(page("2-circle-and-quadrant")).page
    shown.emulate_media(media="print")
    shown.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    tasks = sum(exercise.rules.tasks for exercise in ready("2-circle-and-quadrant").exercises)
    assert shown.locator("form.step:visible").count() == tasks
    assert shown.locator(".answer:visible, .step .go:visible, button:visible, .reasons:visible").count() == 0
    assert all(text.strip() for text in shown.locator(".ask").all_inner_texts())


PLATFORM = """
<!doctype html><html lang="en"><title>platform</title><script>
const calls = [];
const values = { "cmi.core.student_name": "Wang, Xiaoming", "cmi.core.lesson_status": "not attempted" };
const KNOWN = /^cmi\\.core\\.(student_name|lesson_status|session_time|score\\.(raw|min|max))$/;
let state = "out";
function change(name, text, from, to) {
  calls.push(name);
  if (text !== "" || state !== from) return "false";
  state = to;
  return "true";
}
window.API = {
  LMSInitialize(text) { return change("LMSInitialize", text, "out", "in"); },
  LMSFinish(text) { return change("LMSFinish", text, "in", "over"); },
  LMSCommit(text) { calls.push("LMSCommit"); return String(text === "" && state === "in"); },
  LMSGetValue(name) { calls.push(`get ${name}`); return state === "in" && KNOWN.test(name) ? values[name] ?? "" : ""; },
  LMSSetValue(name, value) {
    calls.push(`set ${name}`);
    if (state !== "in" || !KNOWN.test(name) || typeof value !== "string") throw new Error(`${state} ${name} ${value}`);
    values[name] = value;
    return "true";
  },
};
</script><iframe style="width: 900px; height: 700px"></iframe></html>
"""


FRAMED = """html => {
  const framed = document.querySelector("iframe").contentDocument;
  framed.open();
  framed.write(html);
  framed.close();
}"""


def test_a_learning_platform_gets_the_score(open_page: OpenPage) -> None:
    shown = open_page(PLATFORM).page
    shown.evaluate(FRAMED, page("1-first-blocks"))
    frame = shown.frames[1]
    assert frame.locator("#name").input_value() == "Wang, Xiaoming"
    frame.fill("#class", "1")
    frame.click("#start button")
    tasks = sum(exercise.rules.tasks for exercise in ready("1-first-blocks").exercises)
    for _ in range(tasks):
        frame.locator("form.step:not(.aside-now) .pass").click()
    values = shown.evaluate("values")
    assert values["cmi.core.lesson_status"] == "completed"
    assert [values[f"cmi.core.score.{name}"] for name in ("min", "max", "raw")] == ["0", "100", "0"]
    shown.evaluate("document.querySelector('iframe').remove()")
    assert shown.evaluate("[calls[0], calls[calls.length - 1], state]") == ["LMSInitialize", "LMSFinish", "over"]
    assert len(shown.evaluate("values['cmi.core.session_time']").split(":")) == 3
