"""The two-axis table: motors, drives, guides and slides that follow pulses; what crosses the border is a `Trace`."""
