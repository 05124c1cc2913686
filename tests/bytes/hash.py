"""Hashes every kind of output of one program, or compares the hashes of two."""

import argparse
import csv
import hashlib
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

ACCELERATORS = ["raster", "none", "middle", "equal", "sah", "hlbvh"]
INSTRUCTION_SETS = ["portable", "sse4.1", "avx2", "avx512"]
ALL_CHANNELS = "Z,t,A,id,prim,instance,N,P,uv"
SIZE = "96x64"
# More primitives take `--accel none` and the exact arithmetic of `bench` too long.
FEW = 20_000

# Times and other figures of the machine, and prose, which may be improved.
UNSTABLE = {"ms", "load_ms", "build_ms", "trace_ms", "mrays_per_s", "cycles_per_ray", "peak_bytes"}
UNSTABLE |= {"machine", "time", "started", "finished", "error", "warnings", "message", "note", "simd"}
TIMEOUT_SECONDS = 300
# The exit code of an unknown flag.
USAGE = 2


def roots():
    """The folders that hold scenes, by the names that they have in hashes."""
    found = {"feimos": pathlib.Path.cwd()}
    if corpus := os.environ.get("FEIMOS_CORPUS"):
        found["corpus"] = pathlib.Path(corpus).resolve()
    return found


def scenes():
    """Scenes of the repository and of the corpus, relative to the folder of a run, in a fixed order."""
    found = []
    for name, root in roots().items():
        folders = ["scenes", "tests/hard", "tests/cases"] if name == "feimos" else ["."]
        paths = [path for folder in folders for path in sorted((root / folder).rglob("*.pbrt"))]
        # Larger ones are huge on purpose: their tests look at limits, not at images.
        small = [path for path in paths if path.stat().st_size < 1 << 22]
        found += [pathlib.Path(name) / path.relative_to(root) for path in small]
    return found


def stable(value):
    """`value` without the entries that differ from run to run."""
    if isinstance(value, dict):
        is_stable = lambda key: key not in UNSTABLE and not key.endswith("_ms")
        return {key: stable(part) for key, part in value.items() if is_stable(key)}
    return [stable(part) for part in value] if isinstance(value, list) else value


def stable_csv(text):
    rows = csv.DictReader(io.StringIO(text))
    times = ("ms", "mrays", "cycles")
    keep = lambda name: not any(name.split("_")[-1] in times or time in name for time in times)
    return [{name: cell for name, cell in row.items() if keep(name)} for row in rows]


def digest(content):
    if not isinstance(content, bytes):
        content = json.dumps(content, sort_keys=True).encode()
    return hashlib.sha256(content).hexdigest()[:24]


class Run:
    """Runs one program on one scene and collects the hashes of its outputs."""

    def __init__(self, program, scene, folder):
        self.program, self.scene, self.folder = program, scene, pathlib.Path(folder)
        self.hashes = {}

    def feimos(self, *arguments):
        command = [self.program, *map(str, arguments)]
        return subprocess.run(command, cwd=self.folder, capture_output=True, timeout=TIMEOUT_SECONDS)

    def add(self, name, status, content):
        self.hashes[f"{self.scene} {name}"] = f"{status} {digest(content)}"

    def image(self, flags, extension="exr", is_new=False):
        """Renders with `flags` and hashes the file. Older builds may refuse what is new: then there is no output."""
        name = f"out.{extension}"
        (self.folder / name).unlink(missing_ok=True)
        ran = self.feimos("render", self.scene, "-q", "-o", name, "--resolution", SIZE, *flags.split())
        if is_new and ran.returncode == USAGE:
            return False
        path = self.folder / name
        self.add(f"{extension} {flags}", ran.returncode, path.read_bytes() if path.exists() else b"")
        return ran.returncode == 0

    def lines(self, name, *arguments):
        """Hashes the JSON that a command prints, without times."""
        ran = self.feimos(*arguments)
        documents = []
        decoder, text = json.JSONDecoder(), ran.stdout.decode(errors="replace").strip()
        while text:
            document, end = decoder.raw_decode(text)
            documents.append(document)
            text = text[end:].strip()
        self.add(name, ran.returncode, stable(documents))
        return documents

    def all(self):
        self.lines("check", "check", self.scene, "--json", "-q")
        told = self.lines("json", "render", self.scene, "-q", "--json", "--stats", "-o", "j.exr", "--resolution", SIZE)
        if not told:
            return self.hashes
        is_small = told[0]["primitives"] <= FEW
        self.engines(is_small)
        self.formats()
        self.crops()
        self.commands(is_small)
        return self.hashes

    def engines(self, is_small):
        for accel in ACCELERATORS:
            if accel != "none" or is_small:
                for precision in ["exact", "fast"]:
                    self.image(f"--accel {accel} --precision {precision} --threads 2")
        for simd in INSTRUCTION_SETS:
            self.image(f"--simd {simd} --threads 1 --aov {ALL_CHANNELS}")
            self.image(f"--simd {simd} --threads 1 --aov A")
            self.image(f"--simd {simd} --threads 1 --precision fast")

    def formats(self):
        for view in ["depth", "hit", "id", "normal", "depth16", "cost"]:
            self.image(f"--view {view}", "png")
        for flags in ["shaded", "mask", "prim", "instance", "id16", "instance16", "depth --legend --background white"]:
            self.image(f"--view {flags}", "png", is_new=True)
        self.image("--colormap viridis --range 1,9", "png")
        self.image("--aov cost")
        self.image("--depth-channel depth.Y --miss 0")
        for extension in ["npy", "pfm"]:
            self.image("", extension)
        self.image(f"--aov {ALL_CHANNELS}", "npy")

    def crops(self):
        names = []
        for index, bounds in enumerate(["0,41,0,64", "41,96,0,30", "41,96,30,64"]):
            name = f"crop{index}.exr"
            flags = ["--pixelbounds", bounds, "--resolution", SIZE, "-q", "-o", name]
            self.feimos("render", self.scene, *flags)
            path = self.folder / name
            self.add(f"crop {bounds}", 0, path.read_bytes() if path.exists() else b"")
            names.append(name)
        merged = self.folder / "merged.exr"
        merged.unlink(missing_ok=True)
        ran = self.feimos("merge", *names, "-o", merged.name, "-q")
        self.add("merged", ran.returncode, merged.read_bytes() if merged.exists() else b"")

    def commands(self, is_small):
        for pixel in ["0,0", "20,31", "48,32"]:
            self.lines(f"pixel {pixel}", "pixel", self.scene, pixel, "--json", "-q", "--resolution", SIZE)
        self.feimos("render", self.scene, "-q", "-o", "f.exr", "--precision", "fast", "--resolution", SIZE)
        self.feimos("render", self.scene, "-q", "-o", "e.exr", "--resolution", SIZE)
        self.lines("compare", "compare", "e.exr", "f.exr", "--json", "-q", "--diff", "diff.png")
        diff = self.folder / "diff.png"
        self.add("difference", 0, diff.read_bytes() if diff.exists() else b"")
        if is_small and "tests/hard" in str(self.scene):
            self.bench("bench", "none,sah")
            self.bench("bench raster", "raster")

    def bench(self, name, accel):
        """Hashes the rows of `bench`."""
        rows = self.folder / "rows.csv"
        rows.unlink(missing_ok=True)
        flags = f"--runs 1 --warmup 0 --accel {accel} --json -q --csv {rows.name}".split()
        self.lines(name, "bench", self.scene, *flags)
        self.add(f"{name} csv", 0, stable_csv(rows.read_text()) if rows.exists() else b"")


def hashes(program, scene):
    """Hashes of everything that `program` writes of `scene`."""
    # Paths stand in outputs, so scenes are reached by the same ones from wherever this is run.
    with tempfile.TemporaryDirectory() as folder:
        for name, root in roots().items():
            (pathlib.Path(folder) / name).symlink_to(root)
        return Run(program, scene, folder).all()


def all_hashes(program, paths):
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        found = {}
        for part in pool.map(lambda scene: hashes(program, scene), paths):
            found.update(part)
        return found


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("programs", nargs="+", metavar="PROGRAM")
    parser.add_argument("--only", default="", metavar="TEXT", help="scenes whose path contains TEXT")
    options = parser.parse_args()
    paths = [path for path in scenes() if options.only in str(path)]
    programs = [os.path.realpath(program) for program in options.programs]
    old = all_hashes(programs[0], paths)
    if len(programs) == 1:
        for name, value in old.items():
            print(value, name)
        return
    new = all_hashes(programs[1], paths)
    # What only the new program writes is no difference.
    differing = [name for name in old if old[name] != new.get(name)]
    for name in differing:
        print(f"{old[name]} -> {new.get(name)}: {name}")
    print(f"{len(old)} outputs, {len(differing)} differ")
    sys.exit(1 if differing else 0)


if __name__ == "__main__":
    main()
