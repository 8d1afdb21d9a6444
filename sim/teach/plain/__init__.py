"""3B in plain Python: what a lesson reads, decodes, steps and marks; the script of its pages is made of these files.

`tests/tools/plain_script.py` writes them as a script, so that a page and `drycut class mark` go by the same lines. It
knows part of Python: functions of positional parameters, named tuples, lists, numbers and texts. Every rule of 3B here
is held to the parser's (docs/3b.md) block by block, by tests.
"""
