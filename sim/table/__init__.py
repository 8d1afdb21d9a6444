"""The two-axis table: motors, drives and slides follow pulses; out come `Trace`, `History`, `Loss`, `Peak`."""
