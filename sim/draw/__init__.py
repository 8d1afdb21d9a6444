"""Pictures: pygame draws, pillow finishes; nothing outside this package imports either."""
