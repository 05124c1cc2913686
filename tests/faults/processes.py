"""Signals at random moments, several writers of one file, full disks, and systems without files that have no name."""

import os
import shutil
import signal
import subprocess
import tempfile
import time

from workspace import exit_faults, files

SIGNALS = [
    signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGQUIT, signal.SIGXCPU,
    signal.SIGUSR1, signal.SIGUSR2, signal.SIGALRM, signal.SIGKILL,
]
# Without /proc a file without a name cannot get one.
WITHOUT_PROC = ["unshare", "--mount", "sh", "-c", 'umount -l /proc && exec "$@"', "sh"]


def can_hide_proc():
    """Whether this user may take /proc away from a program."""
    return subprocess.run([*WITHOUT_PROC, "true"], capture_output=True).returncode == 0


def signal_faults(workspace, random, before=()):
    """Ends a command by a signal, and does the rest of its work."""
    name = random.choice(["cameras", "force", "old", "png", "merge"])
    # Only /proc tells that nohup is at work, so without it the program does not touch SIGHUP.
    sent = random.choice([sent for sent in SIGNALS if not before or sent != signal.SIGHUP])
    folder = workspace.folder()
    child = subprocess.Popen(
        [*before, *workspace.arguments(name)], cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE
    )
    wait = random.uniform(0, 0.12)
    time.sleep(wait)
    child.send_signal(sent)
    stderr = child.communicate(timeout=60)[1]
    what = f"{name}: {sent.name} after {wait * 1e3:.1f} ms"
    faults = list(exit_faults(child.returncode, stderr, [sent]))
    # Between the two steps of replacing a file nothing helps against SIGKILL.
    may_hide = sent == signal.SIGKILL
    faults += workspace.faults(name, folder, child.returncode, may_hide)
    again = workspace.arguments(name) + (["--skip-existing"] if name == "cameras" else [])
    again = subprocess.run(again, cwd=folder, capture_output=True)
    faults += exit_faults(again.returncode, again.stderr)
    faults += workspace.faults(name, folder, again.returncode, may_hide)
    shutil.rmtree(folder)
    return [f"{what}: {fault}\n{stderr.decode(errors='replace')}" for fault in faults]


def writer_faults(workspace, random):
    """Four processes write one image, and one manifest."""
    folder = workspace.folder()
    sides = [random.randint(20, 200) for _ in range(4)]
    command = f"{workspace.program} render ball.pbrt -q --manifest all.jsonl -o".split()
    for side in set(sides):
        subprocess.run([*command, f"{side}.exr", "--resolution", f"{side}x{side}"], cwd=folder, check=True)
    wanted = {side: files(folder)[f"{side}.exr"] for side in sides}
    children = [
        subprocess.Popen([*command, "old.exr", "--resolution", f"{side}x{side}"], cwd=folder, stderr=subprocess.PIPE)
        for side in sides
    ]
    errors = [child.communicate(timeout=60)[1] for child in children]
    faults = [fault for child, error in zip(children, errors) for fault in exit_faults(child.returncode, error)]
    faults += [f"exit code {child.returncode}" for child in children if child.returncode != 0]
    found = files(folder)
    if found["old.exr"] not in wanted.values():
        faults.append("old.exr is of none of four writers")
    faults += [f"{name} is left" for name in found if name.startswith(".feimos-")]
    lines = len(found["all.jsonl"].splitlines())
    if lines != len(set(sides)) + len(sides):
        faults.append(f"the manifest has {lines} lines")
    shutil.rmtree(folder)
    return [f"four writers of sides {sides}: {fault}" for fault in faults]


def full_disk_faults(workspace, random):
    """A disk that becomes full at some moment; `None` where it cannot be made."""
    disk = tempfile.mkdtemp(dir=workspace.directory)
    used = sum(len(content) // 4096 + 1 for content in workspace.before.values()) * 4
    size = used + random.choice([4, 8, 12, 20, 28, 40, 60])
    mount = ["mount", "-t", "tmpfs", "-o", f"size={size}k", "tmpfs", disk]
    if subprocess.run(mount, capture_output=True).returncode != 0:
        return None
    try:
        name = random.choice(["new", "old", "link", "png", "cameras", "force", "merge"])
        shutil.copytree(workspace.inputs, disk, symlinks=True, dirs_exist_ok=True)
        run = subprocess.run(workspace.arguments(name), cwd=disk, capture_output=True, timeout=60)
        faults = list(exit_faults(run.returncode, run.stderr))
        faults += workspace.faults(name, disk, run.returncode)
        if run.returncode not in (0, 75):
            faults.append(f"exit code {run.returncode}")
        return [f"{name} on a disk of {size} kB: {fault}\n{run.stderr.decode()}" for fault in faults]
    finally:
        subprocess.run(["umount", "-l", disk])
        os.rmdir(disk)


def unsynced_folder_faults(workspace):
    """A manifest says that an image is done only when its name is on the disk, too."""
    folder = workspace.folder()
    options = ["-f", "-qq", "-o", "/dev/null", "-e", "trace=fsync", "-e", "inject=fsync:error=EIO"]
    run = subprocess.run(["strace", *options, *workspace.arguments("cameras")], cwd=folder, capture_output=True)
    faults = list(exit_faults(run.returncode, run.stderr))
    if run.returncode != 74 or b'"done"' in files(folder)["all.jsonl"]:
        faults.append(f"exit code {run.returncode}, and the manifest says that images are done")
    shutil.rmtree(folder)
    return [f"a folder that cannot be synced: {fault}" for fault in faults]


def panic_faults(workspace):
    """A panic ends one image of a batch; Rust panics where the system has no random numbers for a table."""
    command = f"{workspace.program} render ball.pbrt second.pbrt --threads 1 -o new-{{stem}}.exr".split()
    faults, images = [], set()
    for when in range(1, 9):
        folder = workspace.folder()
        options = ["-f", "-qq", "-o", "/dev/null", "-e", f"inject=getrandom:error=EIO:when={when}"]
        run = subprocess.run(["strace", *options, *command], cwd=folder, capture_output=True)
        made = [name for name in files(folder) if name.startswith("new-")]
        shutil.rmtree(folder)
        if b".pbrt: internal error: " in run.stderr:
            images.add(len(made))
        if run.returncode not in (0, 70) or b"panicked" in run.stderr:
            faults.append(f"exit code {run.returncode}")
    if images != {1}:
        faults.append(f"beside an image that panics {images} of one other are made")
    return [f"a panic: {fault}" for fault in faults]


def forbidden_link_faults(workspace, call):
    """A link that the system does not follow is not followed by hand; `call` is what the system refuses."""
    folder = workspace.folder()
    link = os.path.join(folder, "link.exr")
    options = ["-f", "-qq", "-o", "/dev/null", "-P", link, "-P", "link.exr", "-e", f"inject={call}:error=EACCES"]
    run = subprocess.run(["strace", *options, *workspace.arguments("link")], cwd=folder, capture_output=True)
    faults = list(exit_faults(run.returncode, run.stderr))
    found = files(folder)
    if run.returncode not in (73, 74) or found != workspace.before:
        changed = [name for name in found if found[name] != workspace.before.get(name)]
        faults.append(f"exit code {run.returncode}, changed: {changed}")
    shutil.rmtree(folder)
    return [f"a link that {call} refuses: {fault}\n{run.stderr.decode()}" for fault in faults]
