"""The families of controllers as data: one TOML each, `Profile` what it says."""
