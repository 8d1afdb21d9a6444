"""``drycut replay`` as a user meets it: films that play back, a page, and bad use."""

import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import imageio_ffmpeg
import numpy as np
import pytest
from command import run_command, run_inside
from PIL import Image

from sim.show.film import writers
from sim.show.film.screen import Look, Screen
from sim.show.film.writers import format_of

PART = "B600 B0 B600 GX L1 B0 B600 B600 GY L2 B600 B0 B600 GX L3 B0 B600 B600 GY L4 DD"
FAULTY = PART.replace("B600 B0 B600 GX L3", "B600 B0 B600 GX L7")
SHORT = ("--seconds", "1", "--fps", "10", "--size", "320x240")
ANIMATED = [".gif", ".webp", ".apng"]


@pytest.fixture
def part(tmp_path: Path) -> Path:
    path = tmp_path / "零件.3b"
    path.write_text(PART, "utf-8")
    return path


def said(done: subprocess.CompletedProcess[bytes]) -> str:
    return done.stderr.decode()


def frames_of(path: Path) -> tuple[list[np.ndarray], int]:
    """Frames of an animated picture, and how many ms they take."""
    frames, taken_ms = [], 0
    with Image.open(path) as picture:
        for number in range(picture.n_frames):
            picture.seek(number)
            frames.append(np.array(picture.convert("RGB")))
            taken_ms += round(picture.info["duration"])
    return frames, taken_ms


@pytest.mark.alike(2)
@pytest.mark.parametrize("suffix", ANIMATED)
def test_an_animated_picture_plays_back(part: Path, tmp_path: Path, suffix: str) -> None:
    file = tmp_path / f"cut{suffix}"
    done = run_inside("replay", part, "-o", file, *SHORT)
    assert (done.returncode, done.stdout.decode()) == (0, f"written: {file}\n")
    frames, taken_ms = frames_of(file)
    assert taken_ms == 1000
    assert 9 <= len(frames) <= 10  # one that equals the one before it makes that one last longer
    assert {frame.shape for frame in frames} == {(240, 320, 3)}
    kerf = [(np.abs(frame.astype(int) - (118, 194, 238)).max(axis=2) < 12).sum() for frame in frames]
    assert all(after > before for before, after in pairwise(kerf[:-2]))


def test_an_mp4_plays_back(part: Path, tmp_path: Path) -> None:
    file = tmp_path / "new" / "cut.mp4"
    done = run_inside("replay", part, "-o", file, *SHORT)
    assert (done.returncode, done.stdout.decode()) == (0, f"written: {file}\n")
    number, seconds = imageio_ffmpeg.count_frames_and_secs(str(file))
    assert (number, seconds) == (10, pytest.approx(1.0, abs=0.05))
    decoder = (imageio_ffmpeg.get_ffmpeg_exe(), "-v", "error", "-i", file, "-f", "rawvideo", "-pix_fmt", "rgb24", "-")
    raw = subprocess.run(decoder, capture_output=True, check=True, stdin=subprocess.DEVNULL).stdout
    frames = np.frombuffer(raw, dtype=np.uint8).reshape(10, 240, 320, 3)
    assert np.abs(frames[-1].astype(int) - frames[0]).max() > 60


@pytest.mark.alike(2)
@pytest.mark.parametrize("suffix", [*ANIMATED, ".mp4"])
def test_the_same_film_is_the_same_bytes(part: Path, tmp_path: Path, suffix: str) -> None:
    one, other = (tmp_path / name / f"cut{suffix}" for name in ("a", "b"))
    for file in (one, other):
        assert run_inside("replay", part, "-o", file, *SHORT).returncode == 0
    assert one.read_bytes() == other.read_bytes()


@pytest.mark.deeper
def test_theme_language_and_machine_change_the_film(part: Path, tmp_path: Path) -> None:
    shown = []
    for options in ((), ("--theme", "dark"), ("--lang", "zh"), ("--wire-diameter", "0.1mm")):
        assert run_inside("replay", part, "-o", tmp_path / "cut.apng", *SHORT, *options).returncode == 0
        shown.append((tmp_path / "cut.apng").read_bytes())
    assert len(set(shown)) == 4


def test_a_failed_verdict_exits_1_with_its_film(tmp_path: Path) -> None:
    (tmp_path / "bad.3b").write_text(FAULTY, "utf-8")
    assert run_inside("replay", tmp_path / "bad.3b", "-o", tmp_path / "cut.gif", *SHORT).returncode == 1
    assert (tmp_path / "cut.gif").exists()


@pytest.mark.deeper
def test_only_the_file_goes_to_stdout_and_progress_to_stderr(part: Path, tmp_path: Path) -> None:
    done = run_command("replay", part, "-o", "cut.gif", *SHORT, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (0, b"written: cut.gif\n")
    assert all(line.startswith("drycut: ") and line.endswith("%") for line in said(done).splitlines())


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("-o", "cut.avi"), "a replay is .html, or a film: .gif, .webp, .apng, .mp4"),
        (("-o", "cut"), "a replay is .html, or a film: .gif, .webp, .apng, .mp4"),
        (("-o", "cut.gif", "--fps", "60"), "a .gif shows 50 frames a second at most, not 60"),
        (("-o", "cut.mp4", "--size", "641x360"), "an even number of pixels"),
        (("-o", "cut.apng", "--seconds", "600"), "would need 27.6 GB of memory"),
        (("-o", "cut.gif", "--size", "big"), "'big' is no size; write it as 1280x720"),
        (("-o", "cut.gif", "--size", "9999x100"), "sizes are 320x240 to 3840x2160"),
        (("-o", "cut.gif", "--seconds", "0"), "--seconds"),
        (("-o", "cut.gif", "--seconds", "nan"), "'nan' is no length of time"),
        (("-o", "cut.gif", "--fps", "0"), "--fps"),
        (("-o", "cut.gif", "--machine", "none"), "none"),
        (("-o", "零件.3b/cut.gif"), "is a file"),
    ],
)
def test_bad_use_exits_2_and_leaves_nothing(part: Path, options: tuple[str, ...], message: str) -> None:
    done = run_inside("replay", part.name, *options, cwd=part.parent)
    assert (done.returncode, done.stdout) == (2, b"")
    assert message in said(done)
    assert list(part.parent.iterdir()) == [part]


@pytest.mark.parametrize("content", [None, "hello"])
def test_a_bad_program_exits_2_and_leaves_nothing(tmp_path: Path, content: str | None) -> None:
    if content is not None:
        (tmp_path / "bad.3b").write_text(content, "utf-8")
    before = list(tmp_path.iterdir())
    done = run_inside("replay", "bad.3b", "-o", "cut.gif", cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, b"")
    assert "bad.3b" in said(done)
    assert list(tmp_path.iterdir()) == before


def test_without_its_encoder_an_mp4_is_refused_with_what_to_install(
    part: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "imageio_ffmpeg", None)
    done = run_inside("replay", part.name, "-o", "cut.mp4", cwd=part.parent)
    assert done.returncode == 2
    assert "pip install 'drycut[film]'" in said(done)
    assert list(part.parent.iterdir()) == [part]


@pytest.mark.parametrize("suffix", [".gif", ".mp4"])
def test_a_film_that_fails_on_the_way_leaves_the_old_file(
    part: Path, monkeypatch: pytest.MonkeyPatch, suffix: str
) -> None:
    file, frame, drawn = part.with_name(f"cut{suffix}"), Screen.frame, []
    file.write_bytes(b"old")

    def fails(*args: object, **named: object) -> object:
        drawn.append(1)
        if len(drawn) == 8:
            raise OSError(28, "No space left on device")
        return frame(*args, **named)  # type: ignore[arg-type]

    monkeypatch.setattr(Screen, "frame", fails)
    done = run_inside("replay", part.name, "-o", file, *SHORT, cwd=part.parent)
    assert done.returncode == 2
    assert "Traceback" not in said(done)
    assert file.read_bytes() == b"old"
    assert sorted(part.parent.iterdir()) == sorted([part, file])


def test_an_encoder_that_writes_nothing_is_told(part: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class Encoder:
        @staticmethod
        def write_frames(*args: object, **named: object) -> object:
            return (None for _ in range(100))

    monkeypatch.setattr(writers, "encoder", lambda: Encoder)
    done = run_inside("replay", part.name, "-o", "cut.mp4", *SHORT, cwd=part.parent)
    assert done.returncode == 2
    assert "the encoder wrote no film" in said(done)
    assert list(part.parent.iterdir()) == [part]


def test_animated_pictures_may_be_as_large_as_memory_allows(tmp_path: Path) -> None:
    look = Look(1280, 720, "light", "en")
    assert format_of(tmp_path / "cut.WEBP", 10.0, 60, look).holds_frames
    assert not format_of(tmp_path / "cut.mp4", 600.0, 60, look).holds_frames
    assert writers.FORMAT_NAMES.split(", ") == [*writers.FORMATS]


@pytest.mark.deeper
def test_a_page_plays_the_run_as_that_of_a_run_does(part: Path, tmp_path: Path) -> None:
    file = tmp_path / "new" / "part.HTML"
    done = run_inside("replay", part, "-o", file, "--kerf")
    assert (done.returncode, done.stdout.decode()) == (0, f"written: {file}\n")
    assert run_inside("run", part, "-o", tmp_path / "run", "--kerf").returncode == 0
    assert file.read_bytes() == (tmp_path / "run" / "replay.html").read_bytes()


def test_without_output_the_ways_to_watch_it_are_told(part: Path) -> None:
    done = run_inside("replay", part)
    assert (done.returncode, done.stdout) == (2, b"")
    assert "-o part.html is a page" in said(done)
    assert "drycut open" in said(done)
