"""Fault drills: a sound program damaged on purpose, each time in one place; what crosses the border is `Drill`."""
