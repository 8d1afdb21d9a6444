"""What the wire leaves of the work; what crosses the border is `Remains`."""
