"""Motion programs of PMAC cards, read: lines to moves to rows; the border is `PMAC`, the reader in `dialect`."""
