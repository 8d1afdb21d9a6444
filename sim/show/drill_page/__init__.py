"""Fault drills as pages: the tasks with what weighs answers, and the sheet of answers; both are made of `Drill`."""

from sim.show.drill_page.page import answers_page, drill_page

__all__ = ["answers_page", "drill_page"]
