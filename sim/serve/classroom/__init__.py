"""A lesson served to a class: pupils answer and hand in, marks come in live; what crosses the border is a lesson."""
