"""Everything that is wrong with programs, without moving a table; what crosses the border is a `CheckResult`."""
