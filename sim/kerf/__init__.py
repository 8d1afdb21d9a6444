"""The kerf: what the wire removed on its real way, the pieces that this leaves, their play and their sizes."""
