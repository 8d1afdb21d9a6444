"""3B text to toolpath: the only package that knows how programs are written."""
