"""What a program tells its controller beside the path: words to count by, and compensation; a row a block."""
