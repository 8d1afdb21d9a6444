"""What a controller makes of each block, to be watched: words decoded, and then the block's end moved aside.

A `Program` goes in; `Decoded` blocks come out, and as a document.
"""
