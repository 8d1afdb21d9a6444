"""The control under sparks: sparks, gap and servo along the stepped path, and what happens on the way.

`Work` goes in; a `ProcessRun` comes out. It is a model of brass wire in water, after an open spark model
(docs/sparks.md), and never the behaviour of a maker's control.
"""
