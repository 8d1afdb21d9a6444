"""How far a free piece can move before it touches; the border type is `Play`."""
