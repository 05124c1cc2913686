"""Looks for files that faults leave short, lost or behind; run it by tests/faults/run."""

import argparse
import itertools
import os
import random
import resource
import signal
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor

import processes
import system_calls
from workspace import Workspace


def arguments():
    parser = argparse.ArgumentParser(prog="tests/faults/run", description=__doc__)
    parser.add_argument("--program", help=argparse.SUPPRESS, required=True)
    parser.add_argument("--seconds", type=float, default=25, help="how long to look [%(default)s]")
    parser.add_argument("--seed", type=int, help="repeat the choices of a run [a new one]")
    parser.add_argument("--directory", help="where to work: another file system, say [that of temporary files]")
    return parser.parse_args()


def take_signals():
    """Programs inherit ignored signals, as nohup makes them, and not handled ones."""
    for number in processes.SIGNALS:
        if signal.getsignal(number) == signal.SIG_IGN:
            signal.signal(number, lambda *_: None)


class Search:
    """Faults that were found, and how many were tried."""

    def __init__(self):
        self.tried, self.found = {}, []

    def add(self, kind, faults):
        self.tried[kind] = self.tried.get(kind, 0) + 1
        for fault in faults:
            self.found.append(fault)
            print(f"WRONG {kind}: {fault}", flush=True)

    def until(self, end, kind, trials):
        """Does trials, which are functions, on all cores."""
        workers = os.cpu_count() or 1
        with ThreadPoolExecutor(workers) as pool:
            while time.monotonic() < end:
                for faults in pool.map(lambda trial: list(trial()), itertools.islice(trials, 4 * workers)):
                    self.add(kind, faults)


def look(workspace, choices, seconds):
    search = Search()
    for _ in range(3):
        search.add("several writers", processes.writer_faults(workspace, choices))
    for _ in range(20):
        faults = processes.full_disk_faults(workspace, choices)
        if faults is None:
            print("skipped: full disks, which take the rights to mount them")
            break
        search.add("full disk", faults)

    start = time.monotonic()
    share = lambda part: start + part * seconds

    def moments(before=()):
        while True:
            seed = choices.random()
            yield lambda seed=seed: processes.signal_faults(workspace, random.Random(seed), before)

    search.until(share(0.3), "signal", moments())
    if processes.can_hide_proc():
        search.until(share(0.45), "signal, no /proc", moments(processes.WITHOUT_PROC))
    else:
        print("skipped: signals without /proc, which take the rights to unmount it")
    if system_calls.is_allowed():
        for call in ["?readlink", "?statx,?newfstatat"]:
            search.add("forbidden link", processes.forbidden_link_faults(workspace, call))
        search.add("panic", processes.panic_faults(workspace))
        search.add("unsynced folder", processes.unsynced_folder_faults(workspace))
        injections = system_calls.plan(workspace, choices)
        trials = (lambda injection=injection: system_calls.check(workspace, injection) for injection in injections)
        search.until(share(1), "system call", trials)
    else:
        print("skipped: system calls that fail, since strace is not allowed to trace here")
    return search


def main():
    options = arguments()
    if sys.stdin is None:
        # Rust ends a program that is started with a closed stream and cannot open one instead.
        os.set_inheritable(os.open(os.devnull, os.O_RDWR), True)
    take_signals()
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    seed = options.seed if options.seed is not None else random.SystemRandom().randrange(1 << 32)
    print(f"faults: --seed {seed} --seconds {options.seconds:g}", flush=True)
    with tempfile.TemporaryDirectory(dir=options.directory, prefix="feimos-faults-") as directory:
        search = look(Workspace(options.program, directory), random.Random(seed), options.seconds)
    print("faults:", ", ".join(f"{count} of {kind}" for kind, count in search.tried.items()))
    if search.found:
        sys.exit(f"faults: {len(search.found)} WRONG")


if __name__ == "__main__":
    main()
