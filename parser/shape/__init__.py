"""What a path is made of: runs, contours, loops and passes, of any toolpath; `Contour` and `Passes` cross the border."""
