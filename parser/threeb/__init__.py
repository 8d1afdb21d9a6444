"""3B and 4B programs, read: text to records to rows; what crosses the border is a `Toolpath`."""
