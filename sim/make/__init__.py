"""Programs made, of drawings and of other languages, proved before they are given.

What crosses the border is `MadeProgram` and `Converted`, or why there is none.
"""
