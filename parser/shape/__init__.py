"""What a path is made of: runs, contours, loops and passes, of any toolpath; its border: `Contour` and `Passes`."""
