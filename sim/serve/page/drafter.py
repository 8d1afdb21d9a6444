"""The process of a program that is made of a drawing.

A drawing may be huge or hostile: its process can be ended at any moment. What it found is a file of JSON, which may be
large.
"""

from typing import Any, Final

from parser.findings.catalogue import LANGUAGES, Bilingual, Language
from sim.make.cam.maker import MadeProgram, made_program, remarked
from sim.run.recording import stages_of
from sim.serve.page.answers import file_text, printable_entry, read_file
from sim.serve.page.child import PageRequest, do, telling, written
from sim.serve.page.making import asked_of, by_controls
from sim.serve.page.model import DraftedEntry
from sim.show.refusals import why_refused
from sim.show.terminal.program import advice, against, to_check, told_lines
from sim.show.texts import Words

_WIDE: Final = 100_000
"""Cells of a line that is not to be broken."""


def _make(request: PageRequest) -> dict[str, Any]:
    """Make a program of the drawing, and prove it by a run."""
    drawing, making, wanted, scenario = asked_of(request)
    progress = telling(["drawing", "figures", "write", *stages_of(scenario), "comparison"])
    done = made_program(drawing, making, wanted, scenario, progress)
    if not isinstance(done, MadeProgram):
        why = printable_entry(by_controls(why_refused(done.refusal)))
        return written(request, {"program": None, "told": [why], "verdict": "fail"})
    both_lines = zip(*(_summary(done, language) for language in LANGUAGES), strict=True)
    lines = [by_controls(Bilingual(*both)) for both in both_lines]
    data = done.data if done.is_proved else remarked(done, [*against(done, "en")], wanted).data
    drafted: DraftedEntry = {
        "program": file_text(f"{drawing.stem}.{wanted.language}", read_file(data)),
        "told": list(map(printable_entry, lines)),
        "verdict": done.verdict,
    }
    return written(request, drafted)


def _summary(done: MadeProgram, language: Language) -> list[str]:
    """What there is to say of a program: whether it is proved, what speaks against it, what helps, what was chosen."""
    words = Words(language)
    proved = [words(f"program.verdict-{done.proof.verdict}")] if done.proof else []
    todo = advice(done, language, words("program.tab-control", label=words("open.tab")))
    checked = [*to_check(done.plan, language)]
    first = [*checked, *proved] if done.is_proved else [*proved, *checked]
    return [*first, *against(done, language), *todo, *told_lines(done.plan, language, _WIDE)]


if __name__ == "__main__":
    do({"program": _make})
