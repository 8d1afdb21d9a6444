"""Drills of operation: a cut under sparks in which something is wrong, judged by how it goes on.

`Started` goes in; `OperationDrill` comes out.
"""
