"""The kerf: the region that the wire removed on its real way; what crosses the border are polygons in µm."""
