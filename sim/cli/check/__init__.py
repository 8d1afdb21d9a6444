"""``drycut check``: its options, the jobs they ask for, what it mends, and where the results go."""
