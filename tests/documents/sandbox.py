"""The empty folder in which the blocks of a document run, and what they find around it."""

import os
import shlex
import subprocess
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
STAND_INS = Path(__file__).with_name("stand-ins")
URL = "https://github.com/feimos/feimos"
# Where documents that need a clone have it: as `git clone` names it.
CLONE = "feimos"
# Variables that would change what documents do.
UNSET = [
    *["FEIMOS", "CARGO_TARGET_DIR", "GIT_DIR", "GIT_WORK_TREE", "PYTHONPATH", "BASH_ENV", "ENV"],
    *["OPENCV_IO_ENABLE_OPENEXR", "RAYON_NUM_THREADS", "NO_COLOR", "CLICOLOR_FORCE"],
]


class Sandbox:
    """Folders below `root`: `work` is the document's, the others are around it."""

    def __init__(self, root, feimos, python, with_cargo):
        self.work, self.home, self.outputs = root / "work", root / "home", root / "outputs"
        self.programs, self.python = root / "bin", python
        self.left_out = self.outputs / "left-out"
        for folder in [self.work, self.home, self.outputs, self.programs, root / "tmp"]:
            folder.mkdir(parents=True)
        self.environment = dict(os.environ)
        for name in UNSET:
            self.environment.pop(name, None)
        self.environment.update(self.places(root), PATH=f"{self.programs}:{os.environ['PATH']}")
        self.add_programs(feimos)
        self.add_git()
        self.add_cargo(with_cargo)

    def places(self, root):
        """Programs write to their own folders here, not to those of the user."""
        home = str(self.home)
        return {
            "HOME": home,
            "TMPDIR": str(root / "tmp"),
            "XDG_CONFIG_HOME": f"{home}/.config",
            "XDG_CACHE_HOME": f"{home}/.cache",
            "XDG_DATA_HOME": f"{home}/.local/share",
            "DOCUMENTS_LEFT_OUT": str(self.left_out),
            "PYTHONDONTWRITEBYTECODE": "1",
            "PYTHONNOUSERSITE": "1",
            "LC_ALL": "C.UTF-8",
            "COLUMNS": "100",
        }

    def add_programs(self, feimos):
        (self.programs / "feimos").symlink_to(feimos)
        for name in ["pip", "pip3"]:
            (self.programs / name).symlink_to(STAND_INS / "pip")
        if self.python:
            # No link: Python looks for its environment beside the name it was started by.
            text = f'#!/bin/sh\nexec {shlex.quote(str(self.python))} "$@"\n'
            for name in ["python", "python3"]:
                script = self.programs / name
                script.write_text(text)
                script.chmod(0o755)

    def add_git(self):
        """`git clone` of the project clones this checkout, with the command as it is documented."""
        settings = self.home / ".gitconfig"
        settings.write_text(
            f'[url "{REPOSITORY}"]\n\tinsteadOf = {URL}.git\n\tinsteadOf = {URL}\n'
            "[safe]\n\tdirectory = *\n[advice]\n\tdetachedHead = false\n"
        )
        self.environment["GIT_CONFIG_GLOBAL"] = str(settings)

    def add_cargo(self, with_cargo):
        """Cargo with the packages and the toolchains of the user, and all else in the sandbox."""
        (self.programs / "cargo").symlink_to(STAND_INS / "cargo")
        user = Path(os.environ.get("CARGO_HOME", Path.home() / ".cargo"))
        own = self.home / ".cargo"
        own.mkdir()
        for name in ["registry", "config", "config.toml"]:
            if (user / name).exists():
                (own / name).symlink_to(user / name)
        target = os.environ.get("CARGO_TARGET_DIR", REPOSITORY / "target")
        self.environment.update(
            CARGO_HOME=str(own),
            RUSTUP_HOME=os.environ.get("RUSTUP_HOME", str(Path.home() / ".rustup")),
            CARGO_NET_GIT_FETCH_WITH_CLI="true",
            DOCUMENTS_CARGO=os.environ["PATH"] if with_cargo else "",
            DOCUMENTS_TARGET=str(Path(target).resolve()),
        )

    def clone(self):
        """The clone for blocks that run in one; it is made for the first of them."""
        folder = self.work / CLONE
        if not folder.exists():
            command = ["git", "clone", "--quiet", URL, folder]
            subprocess.run(command, check=True, env=self.environment, cwd=self.work)
        return folder

    def commands_left_out(self):
        """Commands that stand-ins did not run: pairs of a command and the reason."""
        if not self.left_out.exists():
            return []
        return [tuple(line.split("\t")) for line in self.left_out.read_text().splitlines()]
