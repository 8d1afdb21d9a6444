"""A program for the card, in C: started against the library, its log read, run again: a `ClientRun`."""
