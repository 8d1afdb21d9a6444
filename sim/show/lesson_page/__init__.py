"""The page of a lesson: one file that needs no other, and marks itself by the rules of `sim.teach.plain`."""

from sim.show.lesson_page.page import lesson_page

__all__ = ["lesson_page"]
