"""What every dialect has in common: what its reader gives and offers; the border types are `Reader` and `Mender`."""
