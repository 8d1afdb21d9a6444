"""3B and 4B programs, read: text to records to rows; the border is `THREE_B`, the reader in `dialect`."""
