"""What every dialect has in common: what its reader gives and offers; the border type is `Reader`."""
