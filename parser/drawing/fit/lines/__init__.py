"""Dense polylines as arcs through their vertices; the border type is `Fitted`."""
