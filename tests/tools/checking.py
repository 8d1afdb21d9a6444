"""``drycut check`` in a process of its own, and a sound program for it."""

from pathlib import Path

from command import run_command

SOUND = "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n"
WRONG_AXIS = SOUND.replace("GYNR1", "GXNR1")


def drycut(*arguments: object, stdin: bytes = b"", cwd: Path | None = None, **environment: str) -> tuple[int, str, str]:
    done = run_command(*arguments, stdin=stdin, cwd=cwd, **environment)
    return done.returncode, done.stdout.decode(), done.stderr.decode()
