"""What a class has: drills of sound programs, and lessons with their marks; what crosses the border is `Drill`."""
