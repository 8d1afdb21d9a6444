"""The page of ``drycut open``: one file without data; what it shows it asks for."""
