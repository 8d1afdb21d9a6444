"""What a class is given: fault drills of a sound program; what crosses the border is `Drill`."""
