"""Pages of a marked class: one of the class, and one of each pupil; what crosses the border is a `ClassResult`."""

from sim.show.class_page.page import class_page, entry_page, pupil_page

__all__ = ["class_page", "entry_page", "pupil_page"]
