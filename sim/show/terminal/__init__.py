"""What commands print for people: tables of a run, a comparison, a circular test; the border type is text."""
