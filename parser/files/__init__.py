"""Files as they come in: read up to a limit, and recognised by what they hold; the border is bytes and terms."""
