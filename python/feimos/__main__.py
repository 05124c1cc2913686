"""The program ``feimos``: the same command line as that of the native program."""

import os
import signal
import sys


def main() -> None:
    """Run the command line with the arguments of this process, and exit with its code."""
    # Before any file is opened: loading it notes whether the caller has closed standard output.
    from feimos._feimos import run

    _fill_standard_streams()
    # Python's handler waits for Python code to run. Signals that the caller ignores stay ignored.
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    # The end of the interpreter would only take time: the program leaves nothing to Python.
    os._exit(run(["feimos", *sys.argv[1:]]))


def _fill_standard_streams() -> None:
    """Open the null device in place of closed streams, so that no image becomes one of them."""
    for descriptor in range(3):
        try:
            os.fstat(descriptor)
        except OSError:
            os.open(os.devnull, os.O_RDWR)


if __name__ == "__main__":
    main()
