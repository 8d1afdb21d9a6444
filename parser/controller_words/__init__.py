"""What controllers are told beside the path, a row a block: `StepWords` to count by, and `Compensation`."""
