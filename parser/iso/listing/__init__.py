"""The text of a program as words in blocks: text to `Listing`, and nothing of what they mean."""
