"""Puts machine code of all compiled loops into a wheel, which is then of this system and architecture.

Who installs that wheel compiles nothing. Off unless the environment has ``HATCH_BUILD_HOOKS_ENABLE=1``, as `make
release` does: to compile takes 20 s, and a check needs no loop.
"""

import platform
import sys
import sysconfig
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

INTO = "controller/compiled/ready"
"""Where `controller.compiled.entries` looks for the package's own entries."""


class LoopsHook(BuildHookInterface[Any]):
    """Adds the entries of `sim.cli.compile` to a wheel."""

    def dependencies(self) -> list[str]:
        """What has to be there to compile loops: all that their modules import."""
        core = self.metadata.core
        return [*core.dependencies, *core.optional_dependencies["run"]]

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile, and name the files. OSError where no folder can be written that holds them."""
        if version == "editable":
            return  # set-up compiles them where they are
        sys.path.insert(0, self.root)
        from sim.cli.compile import compile_loops  # noqa: PLC0415 - what is imported has to be installed first

        files = compile_loops()
        if missing := [file for file in files if not file.is_file()]:
            raise OSError(f"{missing[0].parent} cannot be written, where compiled loops are stored")
        build_data["force_include"].update({str(file): f"{INTO}/{file.name}" for file in files})
        build_data["pure_python"] = False
        build_data["tag"] = f"py3-none-{_system()}"


def _system() -> str:
    """The systems that the code is for, as tags of wheels name them.

    It calls nothing but functions of C's library that every release has, so the oldest are named that numpy has wheels
    for.
    """
    if sys.platform == "linux":
        return f"manylinux_2_17_{platform.machine()}"
    if sys.platform == "darwin":
        return f"macosx_11_0_{platform.machine()}"
    return sysconfig.get_platform().replace("-", "_").replace(".", "_")
