"""Programs written: a draft of curves, stops and offsets to the text of 3B, 4B or ISO; `Draft` in, `Written` out.

Each block begins where the one before it decodes to, so that rounding does not add up (docs/iso.md §10).
"""
