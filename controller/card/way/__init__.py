"""The way that a card drove X and Y along while a program used it: a `Way`."""
