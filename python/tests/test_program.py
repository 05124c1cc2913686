"""The program that the wheel installs: as the native one, though Python starts it.

The tests of the native program, `tests/cli`, run on it as well: see `python/run`.
"""

import os
import signal
import subprocess
import sys
import time

import pytest

import feimos
from conftest import PROGRAM, SCENES

posix = pytest.mark.skipif(os.name != "posix", reason="streams and signals of POSIX")


def shell(script: str, folder) -> "subprocess.CompletedProcess[str]":
    environment = dict(os.environ, FEIMOS=str(PROGRAM), SCENES=str(SCENES))
    return subprocess.run(
        ["bash", "-c", script],
        capture_output=True,
        text=True,
        timeout=120,
        cwd=folder,
        env=environment,
    )


def test_versions_agree(program):
    ran = program("--version")
    assert ran.stdout.splitlines()[0] == f"feimos {feimos.__version__}"
    assert (ran.returncode, ran.stderr) == (0, "")


def test_the_package_runs(program):
    command = [sys.executable, "-m", "feimos", "render", "--help"]
    ran = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert ran.stdout == program("render", "--help").stdout and "Usage: feimos render" in ran.stdout


def test_the_program_does_not_load_numpy():
    script = "import sys, feimos.__main__, feimos._feimos; sys.exit('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", script], timeout=60).returncode == 0


def test_exit_codes(program, tmp_path):
    assert program("render", "--bogus").returncode == 2
    assert program("render", tmp_path / "nowhere.pbrt", "-o", tmp_path / "a.exr").returncode == 66


@posix
def test_names_that_are_no_text(tmp_path):
    copy = 'name=$(printf "s\\xff.pbrt"); cp "$SCENES/sphere.pbrt" "$name"; '
    ran = shell(copy + '"$FEIMOS" check "$name"', tmp_path)
    assert ran.returncode == 0, ran.stderr


@posix
def test_a_reader_that_leaves(tmp_path):
    ran = shell('"$FEIMOS" man --help | true; echo "${PIPESTATUS[0]}"', tmp_path)
    assert "Traceback" not in ran.stderr and "panicked" not in ran.stderr


@posix
def test_a_closed_standard_output(tmp_path):
    ran = shell('"$FEIMOS" --version >&-', tmp_path)
    assert ran.returncode == 74
    assert "error: standard output: cannot write: Bad file descriptor" in ran.stderr
    ran = shell('"$FEIMOS" render "$SCENES/sphere.pbrt" -o a.npy >&- 2>&- <&-', tmp_path)
    assert ran.returncode == 0
    ran = shell('"$FEIMOS" render "$SCENES/sphere.pbrt" -o b.npy && cmp a.npy b.npy', tmp_path)
    assert ran.returncode == 0, ran.stderr


@posix
def test_an_interrupt_ends_it_as_usual(tmp_path):
    scene = str(SCENES / "sphere.pbrt")
    arguments = ["render", scene, "-o", "a.exr", "--resolution", "20000x20000"]
    with subprocess.Popen(
        [str(PROGRAM), *arguments], cwd=tmp_path, stderr=subprocess.PIPE, text=True
    ) as process:
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        stderr = process.communicate(timeout=60)[1]
    assert process.returncode == -signal.SIGINT
    assert "Traceback" not in stderr and "ended by SIGINT" in stderr
    assert os.listdir(tmp_path) == []
