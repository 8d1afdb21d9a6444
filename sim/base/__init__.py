"""What all rooms stand on: files written whole, workers, progress, units, rounded numbers; it knows no program.

Its types are `StepFiles`, a `Pool` of workers, and the `Progress` of a run.
"""
