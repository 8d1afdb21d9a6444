"""Stepping: paths and plans to steps of 1 µm and their pulses, point by point or at equal times.

A `Toolpath` or `Path` goes in with its `Plan`; `Steps` and `Pulses` come out.
"""
