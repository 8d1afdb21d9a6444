"""The replay's page: one file that plays a recorded run, with nothing to load and nothing to install."""

from pathlib import Path

from sim.run.recording import Recording
from sim.show.html.environment import rendered
from sim.show.replay.document import replay_document

_ASSETS = Path(__file__).with_name("assets")
_SCRIPTS = (
    *("decode.js", "decisions.js", "nearest.js", "model.js"),
    *("words.js", "view.js", "layer.js", "detail.js", "path.js", "scene.js", "kerf.js", "wire.js", "micro.js"),
    *("scale_bar.js", "stage.js", "player.js", "program.js", "tip.js", "timeline.js", "readouts.js", "findings.js"),
    *("quiz.js", "keys.js", "pointer.js", "controls.js", "main.js"),
)
"""In the order in which they run: each adds to what those before it gave."""


def replay_page(recording: Recording) -> str:
    """HTML of ``replay.html`` for a recorded run."""
    return rendered(_ASSETS, "replay.html.j2", document=replay_document(recording), scripts=_SCRIPTS)
