"""All steps of a program, in chunks one after the other."""

from collections.abc import Iterator

from controller.stepping.chunks import CHUNK_STEPS, StepChunk, chunk_of
from controller.stepping.steps import Steps


def chunks_of(steps: Steps, size: int = CHUNK_STEPS) -> Iterator[StepChunk]:
    """Chunks of `size` steps; the last may be shorter."""
    return (chunk_of(steps, since, min(since + size, len(steps))) for since in range(0, len(steps), size))
