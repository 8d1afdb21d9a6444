"""The card's library for programs in C: the table of its functions, C made of it, and the card in a program's process.

A `Prototype` is a row of the table.
"""
