"""Runs the blocks of one document in their order."""

import time

import shell
from outputs import matches
from session import Session
from shell import indented


def run_document(blocks, sandbox, seconds):
    """Returns the failures. What follows a command that failed is not run."""
    end = time.monotonic() + seconds
    session, printed, failures = None, "", []
    try:
        for number, block in enumerate(blocks):
            failure = None
            if block.action == "file":
                write(block, sandbox.work)
            elif block.action == "compared":
                failures += difference(block, printed)
            elif block.action == "run" and block.language == "python":
                if not sandbox.python:
                    return [f"{block.place}: set FEIMOS_PYTHON, or leave out --without-python"]
                session = session or Session(sandbox)
                ended, printed = session.run(block, end - time.monotonic())
                if not ended:
                    failure = f"{block.place}: Python failed\nprinted:\n{indented(printed)}"
            elif block.action == "run":
                failure, printed = shell.run(block, sandbox, end - time.monotonic())
            if failure:
                rest = sum(later.action in {"run", "compared"} for later in blocks[number + 1 :])
                return [*failures, failure + (f"\n{rest} later blocks are not run" if rest else "")]
        return failures
    except ValueError as error:
        return [*failures, f"{block.place}: {error}"]
    finally:
        if session:
            session.close()


def write(block, folder):
    """Writes the file of a block, which stays within the document's folder."""
    path = (folder / block.argument).resolve()
    if folder not in path.parents:
        raise ValueError(f"the file {block.argument} is outside of the document's folder")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(block.text)


def difference(block, printed):
    if matches(block.text, printed):
        return []
    expected, found = indented(block.text), indented(printed)
    return [f"{block.place}: another output\nexpected:\n{expected}\nprinted:\n{found}"]
