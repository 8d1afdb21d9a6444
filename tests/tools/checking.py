"""``drycut check`` as a user meets it, and a sound program for it."""

from pathlib import Path

from command import run_command, run_inside

SOUND = "B9900B0B9900GXL1\nB9900B0B39600GYNR1\nB9900B0B9900GXL3\nDD\n"
WRONG_AXIS = SOUND.replace("GYNR1", "GXNR1")


def drycut(*arguments: object, stdin: bytes = b"", cwd: Path | None = None, **environment: str) -> tuple[int, str, str]:
    """Exit code, stdout and stderr; in a process of its own where it reads from stdin."""
    if stdin:
        done = run_command(*arguments, stdin=stdin, cwd=cwd, **environment)
    else:
        done = run_inside(*arguments, cwd=cwd, **environment)
    return done.returncode, done.stdout.decode(), done.stderr.decode()
