"""Words for people in English and Chinese, from the TOML files beside the modules."""
