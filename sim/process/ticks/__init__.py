"""A cut under sparks, tick by tick: loops, compiled, and the script of the panel, which is made of these files.

`tests/tools/plain_script.py` writes them as a script, so that a panel and a run go by the same lines. It knows part of
Python; docs/sparks.md says what the model is.
"""
