"""Folders with inputs, commands that work in them, and what may be left of their files."""

import json
import os
import shutil
import subprocess
import tempfile

SCENE = """LookAt 0 0 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 40
Film "rgb" "integer xresolution" 40 "integer yresolution" 30 "string filename" "film.exr"
WorldBegin
Include "more.pbrt"
Shape "plymesh" "string filename" "mesh.ply"
"""
MORE = 'Shape "sphere" "float radius" 1\n'
MESH = """ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
-2 -1 2
2 -1 2.5
0 2 2
3 0 1 2
"""
POSES = [{"name": f"c{k}", "lookat": [0, 0, -5, 0, 0, 0, 0, 1, k]} for k in range(4)]

# Exit codes that the README names, but 70: an internal error must not happen.
DOCUMENTED = {0, 1, 2, 65, 66, 73, 74, 75}

# Arguments of each command. A line of a manifest holds times; all other files are the same in each run.
COMMANDS = {
    "new": "render ball.pbrt -o new.exr",
    "old": "render ball.pbrt -o old.exr",
    "link": "render ball.pbrt -o link.exr",
    "png": "render ball.pbrt -o old.png --view normal",
    "npy": "render ball.pbrt -o new.npy",
    "pfm": "render ball.pbrt -o new.pfm",
    "cameras": "render ball.pbrt --cameras poses.json -o {camera}.exr --manifest all.jsonl",
    "force": "render ball.pbrt second.pbrt -o old-{stem}.exr --force",
    "skip": "render ball.pbrt second.pbrt -o same-{stem}.exr --skip-existing --manifest all.jsonl",
    "merge": "merge left.exr right.exr -o old.exr",
    "compare": "compare left.exr same-ball.exr --diff diff.png",
    "check": "check ball.pbrt --json",
    "pixel": "pixel ball.pbrt 20,15",
    "stdout": "render ball.pbrt -o -",
    "bench": "bench ball.pbrt --csv rows.csv --json-file rows.json --runs 1 --warmup 0 --accel sah,none"
    " --precision fast --reference none",
}
# What `bench` writes holds times: rows of an earlier run, or as many of this one.
RESULTS = {"rows.csv": "an earlier run,\n", "rows.json": '{"rows": []}\n'}


class Workspace:
    """All commands, and the files before and after each of them, undisturbed."""

    def __init__(self, program, directory):
        self.program = program
        self.inputs = os.path.join(directory, "inputs")
        self.directory = directory
        os.mkdir(self.inputs)
        self._make_inputs()
        self.before = files(self.inputs)
        self.after = {}
        self.codes = {}
        for name in COMMANDS:
            folder = self.folder()
            self.codes[name] = subprocess.run(self.arguments(name), cwd=folder, capture_output=True).returncode
            self.after[name] = files(folder)
            shutil.rmtree(folder)
            assert self.codes[name] in (0, 1), f"{name} ends with {self.codes[name]} by itself"

    def _make_inputs(self):
        texts = {"ball.pbrt": SCENE, "second.pbrt": SCENE, "more.pbrt": MORE, "mesh.ply": MESH}
        texts["poses.json"] = json.dumps(POSES)
        texts |= RESULTS
        for name, text in texts.items():
            with open(os.path.join(self.inputs, name), "w") as file:
                file.write(text)
        for arguments in [
            "-o old.exr --resolution 10x10",
            "-o real.exr --resolution 10x10",
            "-o old.png --resolution 10x10",
            "-o old-ball.exr --resolution 10x10",
            "-o left.exr --cropwindow 0,0.5,0,1",
            "-o right.exr --cropwindow 0.5,1,0,1",
            "-o same-ball.exr",
        ]:
            command = [self.program, "render", "-q", "ball.pbrt", *arguments.split()]
            subprocess.run(command, cwd=self.inputs, check=True)
        os.symlink("real.exr", os.path.join(self.inputs, "link.exr"))

    def folder(self, parent=None):
        """A new folder with the inputs."""
        folder = tempfile.mkdtemp(dir=parent or self.directory)
        shutil.copytree(self.inputs, folder, symlinks=True, dirs_exist_ok=True)
        return folder

    def arguments(self, name):
        return [self.program, *COMMANDS[name].split()]

    def faults(self, name, folder, code, may_hide=False):
        """What is wrong with the files that a command, which ended with `code`, has left in `folder`."""
        before, after = self.before, self.after[name]
        found = files(folder)
        for path in sorted(before.keys() | after.keys() | found.keys()):
            content = found.get(path)
            if path.startswith(".feimos-"):
                if not may_hide:
                    yield f"{path} is left"
            elif path.endswith(".jsonl"):
                yield from manifest_faults(content or b"", found, after)
            elif path in RESULTS and name == "bench":
                if content != before[path] and rows(path, content) != rows(path, after[path]):
                    yield f"{path} holds neither the old rows nor the new ones"
            elif content not in (before.get(path), after.get(path)):
                size = "gone" if content is None else f"{len(content)} bytes"
                yield f"{path} is neither the old file nor the new one: {size}"
            elif code == self.codes[name] == 0 and content != after.get(path):
                yield f"{path} is not new, but the exit code is 0"


def files(folder):
    """The contents of all files; of links where they lead."""
    contents = {}
    for entry in os.scandir(folder):
        if entry.is_symlink():
            contents[entry.name] = os.readlink(entry.path)
        else:
            with open(entry.path, "rb") as file:
                contents[entry.name] = file.read()
    return contents


def rows(path, content):
    """How many rows a file of results holds; none where it is damaged."""
    try:
        text = (content or b"").decode()
        return len(json.loads(text)["rows"]) if path.endswith(".json") else text.count("\n")
    except (KeyError, ValueError):
        return None


def manifest_faults(content, found, after):
    """Lines that are no records, and images that are done and not complete."""
    for line in content.decode().splitlines():
        try:
            record = json.loads(line)
        except ValueError:
            yield f"a line of the manifest is cut off: {line[:60]}"
            continue
        if record["status"] == "done":
            output = record["image"]["output"]
            if found.get(output) != after.get(output):
                yield f"the manifest says that {output} is done"


def exit_faults(code, stderr, signals=()):
    """What is wrong with how a program ended; by a signal the code is below 0."""
    # The system's loader comes before the program.
    is_loader = code == 127 and b"error while loading shared libraries" in stderr
    if code not in DOCUMENTED and -code not in signals and not is_loader:
        yield f"exit code {code}"
    if b"panicked" in stderr or b"internal error" in stderr:
        yield "a panic"
