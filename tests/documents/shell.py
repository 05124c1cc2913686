"""Runs a block of shell commands, and keeps what each command prints."""

import os
import signal
import subprocess
from dataclasses import dataclass

BASH = ["bash", "-eu", "-o", "pipefail"]


@dataclass
class Command:
    """A whole command, which may have several lines; `line` counts from 0 within its block."""

    line: int
    text: str


def commands_of(text):
    """Cuts a block into its commands. Raises ValueError with a message of bash."""
    commands, start, lines = [], 0, text.splitlines()
    for number, line in enumerate(lines, 1):
        chunk = "\n".join(lines[start:number])
        if all(not row.strip() or row.lstrip().startswith("#") for row in lines[start:number]):
            continue
        if not line.endswith("\\") and not mistake_in(chunk):
            commands.append(Command(start, chunk))
            start = number
    rest = "\n".join(lines[start:])
    if mistake_in(rest):
        raise ValueError(mistake_in(rest))
    return commands


def mistake_in(text):
    """What bash says about the syntax; empty if it is right and complete."""
    check = subprocess.run(
        ["bash", "-n"], input=text + "\n", capture_output=True, text=True, env={"LC_ALL": "C"}
    )
    return check.stderr.strip()


def run(block, sandbox, seconds):
    """Runs a block in one shell; returns the failure, None if there is none, and the last output.

    Each command has a file for what it prints, so the newest file is that of the last command.
    """
    commands = commands_of(block.text)
    files = [sandbox.outputs / f"command-{number}" for number in range(len(commands))]
    script = sandbox.outputs / "script"
    lines = []
    for command, file in zip(commands, files):
        file.unlink(missing_ok=True)
        lines += [f"exec >'{file}' 2>&1", command.text]
    script.write_text("\n".join(lines) + "\n")
    folder = sandbox.clone() if block.marker == "in a clone" else sandbox.work
    code = run_script(script, folder, sandbox.environment, seconds)
    begun = [number for number, file in enumerate(files) if file.exists()]
    last = begun[-1] if begun else 0
    printed = files[last].read_text(errors="replace") if begun else ""
    if code == 0:
        return None, printed
    command = commands[last]
    place = f"{block.document}:{block.line + command.line}"
    ending = "not within the time limit" if code is None else f"exit code {code}"
    return f"{place}: {ending}\n{indented(command.text, '$ ')}\nprinted:\n{indented(printed)}", ""


def run_script(script, folder, environment, seconds):
    """The exit code, or None if the time is over. What is left of the processes is ended."""
    process = subprocess.Popen(
        [*BASH, script],
        cwd=folder,
        env=environment,
        stdin=subprocess.DEVNULL,
        start_new_session=True,
    )
    try:
        return process.wait(timeout=seconds)
    except subprocess.TimeoutExpired:
        return None
    finally:
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass
        process.wait()


def indented(text, mark=""):
    first, *others = text.rstrip("\n").split("\n")
    rows = [mark + first, *(" " * len(mark) + line for line in others)]
    return "\n".join(f"    {row}".rstrip() for row in rows)
