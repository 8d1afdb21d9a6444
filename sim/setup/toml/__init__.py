"""TOML files read strictly and written again, by tables of keys; what crosses the border is a `Section` of `Key`s."""
