"""TOML files read strictly and written again; what crosses the border is a table of plain values."""
