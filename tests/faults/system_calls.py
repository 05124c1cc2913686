"""System calls that fail one after the other, by strace."""

import shutil
import signal
import subprocess

from workspace import COMMANDS, exit_faults

# What can go wrong with each call. Memory is refused by other means: a loader without it does not
# start.
ERRORS = {
    "openat": "EIO EACCES ENOSPC EMFILE ESTALE EROFS ENFILE EDQUOT",
    "read": "EIO EISDIR EINTR ESTALE",
    "write": "EIO ENOSPC EDQUOT EFBIG EINTR EPIPE",
    "lseek": "EIO ESPIPE",
    "statx": "EIO EACCES ESTALE ELOOP",
    "fstat": "EIO",
    "newfstatat": "EIO EACCES",
    "readlink": "EIO EACCES",
    "rename": "EIO EACCES ENOSPC EXDEV EPERM",
    "renameat": "EIO EACCES ENOSPC EPERM",
    "renameat2": "EIO EACCES ENOSPC EINVAL",
    "linkat": "EIO EACCES EPERM EXDEV EOPNOTSUPP ENOENT ENOSPC EMLINK",
    "link": "EIO EACCES EPERM EMLINK",
    "fdatasync": "EIO ENOSPC EDQUOT EINVAL",
    "fsync": "EIO ENOSPC EINVAL",
    "fchmod": "EPERM EIO",
    "fchown": "EPERM EIO",
    "ftruncate": "EIO",
    "close": "EIO",
    "unlink": "EIO EPERM",
    "clone3": "EAGAIN ENOMEM",
    "clone": "EAGAIN",
    "getrandom": "EINTR",
}
SIGNALS = [signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGQUIT, signal.SIGXCPU, signal.SIGUSR1]
LIMIT = 60


def is_allowed():
    """Whether strace works here: a container may forbid it."""
    if shutil.which("strace") is None:
        return False
    return subprocess.run(["strace", "-o", "/dev/null", "true"], capture_output=True).returncode == 0


def counts(workspace, name):
    """How often a command makes each call."""
    folder = workspace.folder()
    log = f"{folder}.log"
    command = ["strace", "-f", "-qq", "-o", log, "-e", f"trace=?{',?'.join(ERRORS)}", *workspace.arguments(name)]
    subprocess.run(command, cwd=folder, capture_output=True, timeout=LIMIT)
    shutil.rmtree(folder)
    with open(log) as lines:
        calls = [line.split()[1].split("(")[0] for line in lines if "(" in line]
    return {call: calls.count(call) for call in ERRORS if call in calls}


def plan(workspace, random):
    """Endless injections, the rare calls as often as the frequent ones."""
    known = {name: counts(workspace, name) for name in COMMANDS}
    while True:
        name = random.choice(list(known))
        call = random.choice(list(known[name]))
        when = random.randint(1, known[name][call])
        if random.random() < 0.2:
            sent = random.choice(SIGNALS)
            yield name, call, f"signal={sent.name}:when={when}", sent
        else:
            error = random.choice(ERRORS[call].split())
            yield name, call, f"error={error}:when={when}{random.choice(['', '+'])}", None


def check(workspace, injection):
    """Runs a command with an injection; yields what is wrong."""
    name, call, fault, sent = injection
    # Without end a call that is tried again would be tried for ever.
    if "EINTR" in fault:
        fault = fault.rstrip("+")
    folder = workspace.folder()
    options = ["-f", "-qq", "--seccomp-bpf", "-o", "/dev/null", "-e", f"trace={call}", "-e", f"inject={call}:{fault}"]
    command = ["strace", *options, *workspace.arguments(name)]
    what = f"{name}: {call}:{fault}"
    try:
        run = subprocess.run(command, cwd=folder, capture_output=True, timeout=LIMIT)
    except subprocess.TimeoutExpired:
        yield f"{what}: does not end within {LIMIT} s"
        return
    faults = list(exit_faults(run.returncode, run.stderr, [sent] if sent else []))
    # What cannot be removed stays.
    faults += workspace.faults(name, folder, run.returncode, may_hide=call == "unlink")
    shutil.rmtree(folder)
    for fault in faults:
        yield f"{what}: {fault}\n{run.stderr.decode(errors='replace')}"
