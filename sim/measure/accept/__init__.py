"""A test piece as it was measured, feature by feature against its limits; what crosses the border is `Judgement`."""
