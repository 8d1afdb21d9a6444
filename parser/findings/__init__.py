"""What can be wrong with a program: codes, pages and errors; what crosses the border is a `Finding`."""
