"""What each pass over an edge comes to, and how much material it takes off; out comes `PassFigures`."""
