"""The card's library for programs in C, made with a compiler of the machine: a `Compiler` and files."""
