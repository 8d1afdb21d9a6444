"""Packs drycut into a folder that needs no Python, and on Windows into an installer: `make windows`.

PyInstaller packs for the system that it runs on; so the installer is made on Windows, with NSIS beside it.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

from parser import __version__

HERE = Path(__file__).parent
DIST = HERE.parents[1] / "dist"


def main() -> None:
    """Pack, try what was packed, and make the installer where that can be."""
    work = DIST / "packing"
    command = [sys.executable, "-m", "PyInstaller", "--noconfirm", "--log-level", "WARN"]
    subprocess.run([*command, "--distpath", DIST, "--workpath", work, HERE / "drycut.spec"], check=True)
    shutil.rmtree(work)
    bundle = DIST / "drycut"
    program = bundle / ("drycut.exe" if sys.platform == "win32" else "drycut")
    ready = bundle / "_internal" / "controller" / "compiled" / "ready"  # so that the first run is as fast as all others
    subprocess.run([program, "-m", "sim.cli.compile"], check=True, env={**os.environ, "NUMBA_CACHE_DIR": str(ready)})
    said = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout
    print(said.strip())
    makensis = shutil.which("makensis")
    if sys.platform != "win32" or makensis is None:
        print(f"{bundle}: no installer: that is made on Windows, with NSIS")
        return
    subprocess.run([makensis, f"/DVERSION={__version__}", f"/DBUNDLE={bundle}", HERE / "setup.nsi"], check=True)


if __name__ == "__main__":
    main()
