"""Runs the code blocks of documents and compares what they print with what they say."""

import argparse
import os
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import shell
from blocks import Reader
from document import run_document
from sandbox import REPOSITORY, Sandbox

ACTIONS = ["run", "compared", "file", "rust", "text", "not run"]


def arguments():
    parser = argparse.ArgumentParser(
        prog="tests/documents/run",
        description=__doc__,
        epilog="Environment: FEIMOS, the program; FEIMOS_PYTHON, a Python with the module, or "
        "FEIMOS_WHEEL, a wheel for one; "
        "FEIMOS_CARGO, the documents whose builds are made, separated by spaces.",
    )
    parser.add_argument("documents", nargs="*", help="Markdown files [all of the repository]")
    parser.add_argument("--list", action="store_true", help="list all blocks and run none")
    parser.add_argument("--without-python", action="store_true", help="leave Python blocks out")
    parser.add_argument("--seconds", type=float, default=300, help="limit a document [%(default)s]")
    return parser.parse_args()


def git(*words):
    """The lines that a command of git prints."""
    command = ["git", *words]
    run = subprocess.run(command, cwd=REPOSITORY, check=True, stdout=subprocess.PIPE, text=True)
    return run.stdout.splitlines()


def all_documents():
    return sorted(set(git("ls-files", "--cached", "--others", "--exclude-standard", "*.md")))


def read(name):
    """The blocks of a document, and its mistakes."""
    blocks, mistakes = Reader(name, (REPOSITORY / name).read_text()).read()
    for block in blocks:
        try:
            # Blocks that are not run have no other test.
            shell.commands_of(block.text if block.language == "sh" else "")
        except ValueError as error:
            mistakes.append(f"{block.place}: {error}")
    library = (REPOSITORY / "src/lib.rs").read_text()
    has_rust = any(block.action == "rust" for block in blocks)
    if has_rust and f'include_str!("../{name}")' not in library:
        mistakes.append(f"{name}: src/lib.rs does not include it, so no doc test has its Rust")
    return blocks, mistakes


def without_python(blocks):
    """Leaves Python out: its blocks become blocks that are not run."""
    for block in blocks:
        if block.language == "python" and block.action == "run":
            block.marker, block.argument = "not run", "--without-python"


def list_blocks(blocks):
    for block in blocks:
        detail = block.reason or block.argument
        first = block.text.split("\n")[0]
        print(f"{block.place:32} {block.language:7} {block.action:9} {detail or first}"[:100])


def run(name, blocks, options):
    """Runs a document; returns its failures and the commands that stand-ins left out."""
    python = None if options.without_python else os.environ.get("FEIMOS_PYTHON")
    with tempfile.TemporaryDirectory(prefix="feimos-documents-") as folder:
        feimos = Path(os.environ["FEIMOS"]).resolve()
        cargo = name in os.environ.get("FEIMOS_CARGO", "").split()
        sandbox = Sandbox(Path(folder).resolve(), feimos, python, cargo)
        # Builds take minutes.
        seconds = options.seconds + (1800 if cargo else 0)
        failures = run_document(blocks, sandbox, seconds)
        return failures, sandbox.commands_left_out()


def summary(blocks, left_out):
    counts = [f"{sum(block.action == action for block in blocks)} {action}" for action in ACTIONS]
    print(f"blocks: {', '.join(counts)}")
    reasons = {}
    for block in blocks:
        if block.action == "not run":
            reasons.setdefault(block.reason, []).append(block.place)
    for reason, places in reasons.items():
        print(f"    not run: {', '.join(places)}: {reason}")
    for command, reason in sorted(set(left_out)):
        print(f"    stand-in: {command}: {reason}")


def main():
    options = arguments()
    # Processes and folders of documents end with the runner.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    failures, everything, left_out = [], [], []
    for name in options.documents or all_documents():
        blocks, mistakes = read(name)
        if options.without_python:
            without_python(blocks)
        everything += blocks
        if options.list:
            list_blocks(blocks)
        elif not mistakes and any(block.action == "run" for block in blocks):
            found, commands = run(name, blocks, options)
            print(f"{'FAILED' if found else 'ok':6}  {name}", flush=True)
            mistakes, left_out = mistakes + found, left_out + commands
        for mistake in mistakes:
            print(mistake, flush=True)
        failures += mistakes
    summary(everything, left_out)
    if git("status", "--porcelain"):
        print("note: blocks in a clone had the last commit, without the changes since then")
    print(f"documents: {len(failures)} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
