"""The picture of the circular test: polar plot, figures and marks of the reversals."""
