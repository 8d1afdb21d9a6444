"""A written program held against its drawing: checked, run, compared; the border type is `Proof`."""
