"""ISO (G-code) for wire-cut machines, read: text to listing to rows; the border is `ISO`, the reader in `dialect`."""
