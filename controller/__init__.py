"""Toolpath to pulses: point-by-point interpolation, the plan of motion in time, and the card."""
