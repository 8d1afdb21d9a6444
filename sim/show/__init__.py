"""What people see: files, pages, pictures and lines of text made of what is known; it works nothing out itself."""
