"""Pages of fault drills of a small program."""

from functools import cache

from report_pages import PART

from parser.program import Program, parse_program
from sim.check.settings import CheckSettings
from sim.show.drill_page import answers_page, drill_page
from sim.teach.drills import Drill, DrillRequest, drills_of


@cache
def part() -> Program:
    return parse_program(PART, "a <b> part.3b")


@cache
def drills_of_part(count: int = 4) -> tuple[Drill, ...]:
    return drills_of(part(), CheckSettings(), DrillRequest(5, count))


@cache
def tasks(count: int = 4) -> str:
    files = [f"drill-{at:02}.3b" for at in range(1, count + 1)]
    return drill_page(part(), drills_of_part(count), 5, files)


@cache
def answers(count: int = 4) -> str:
    return answers_page(part(), drills_of_part(count), 5)
