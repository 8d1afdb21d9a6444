"""The functions of the card's library, a group a file, each a class over `CardBase`.

Across its border goes a call with its answer: `Logged`.
"""
