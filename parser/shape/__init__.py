"""What a path is made of: runs, contours and loops, of any toolpath; what crosses the border is a `Contour`."""
