"""What is wrong with single words and blocks, whatever they move: `Listing` and `Profile` to findings."""
