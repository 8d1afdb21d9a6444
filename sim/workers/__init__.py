"""Many pieces of work over the cores of this machine or of others; a worker that dies loses none of them."""
