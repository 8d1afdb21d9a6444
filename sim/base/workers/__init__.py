"""Many jobs over the cores of this machine or of others; a worker that dies loses none of them; a border is `Pool`.

What crosses it is a function, jobs for it that can be pickled, and their results: bytes, for no file system is shared.
"""
