"""What serves a program to a person at work, on this machine alone: the page of ``drycut open``, an editor's server."""
