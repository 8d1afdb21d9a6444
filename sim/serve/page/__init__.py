"""A page for one program, served on this machine alone: what it asks, answered; it begins with an `Opened`."""
