"""The replay's page: one file that plays a recorded run, with nothing to load and nothing to install."""

from pathlib import Path

from sim.run.recording import Recording
from sim.show.html.environment import rendered
from sim.show.replay.document import replay_document

_ASSETS = Path(__file__).with_name("assets")


def replay_page(recording: Recording) -> str:
    """HTML of ``replay.html`` for a recorded run."""
    return rendered(_ASSETS, "replay.html.j2", document=replay_document(recording))
