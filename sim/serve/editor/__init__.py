"""A program open in an editor: findings, mends, geometry, outline and format as its language server gives them."""
