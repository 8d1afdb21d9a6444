"""Drills of operation as pages: what happened, what do you do, and a cut that goes on or not; and the sheet of answers.

`OperationEntry` goes in.
"""
