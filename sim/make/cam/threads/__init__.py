"""Where the wire is threaded, and where it comes to the contour from there; the border type is `Thread`."""
