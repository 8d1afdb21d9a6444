"""The fuzz harness: any input gets an answer, in bounded time and memory.

A `Target` (`target.py`) makes inputs from their numbers and judges what drycut answers. `targets.py` lists them all.
`pool.py` hands numbers to worker processes (`worker.py`), which may hang or die; `minimise.py` makes an input shorter.
"""
