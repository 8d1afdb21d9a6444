"""What blocks move, in the order in which they run: `Listing` and `Profile` to the toolpath."""
