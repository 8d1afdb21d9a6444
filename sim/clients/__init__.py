"""Programs in C for the card, started against its library, their logs read and run again: a `ClientRun`.

The library is made with a `Compiler` of the machine.
"""
