"""Mends: which one field, written otherwise, would make a block right, and the edits that are certain."""
