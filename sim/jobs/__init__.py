"""Programs run with their files: one, or thousands of a shop; what crosses the border is `DryRun` and files."""
