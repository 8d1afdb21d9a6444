"""The picture of a run's motion: velocity, acceleration, following error and force of each axis over time."""
