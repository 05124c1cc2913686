"""Threads, interrupts and forks."""

import multiprocessing
import os
import signal
import subprocess
import sys
import textwrap
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import feimos
from conftest import POINTS, SCENES, TRIANGLES, same

SIZE = (90, 70)
posix = pytest.mark.skipif(os.name != "posix", reason="signals and forks of POSIX")


def soup(count: int) -> "feimos.Scene":
    """Random triangles, which take long without a tree."""
    points = np.random.default_rng(5).uniform(-1, 1, size=(3 * count, 3))
    return feimos.mesh(points, np.arange(3 * count).reshape(-1, 3))


def depth(_: int) -> np.ndarray:
    return feimos.load(SCENES / "quadrics.pbrt", resolution=SIZE).render()["Z"]


def test_other_threads_run_during_a_render():
    scene = soup(20_000)
    ticks, is_done = [], threading.Event()

    def tick() -> None:
        while not is_done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.002)

    thread = threading.Thread(target=tick)
    thread.start()
    begin = time.monotonic()
    scene.render([[900, 0, 999], [0, 900, 999], [0, 0, 1]], t=[0, 0, 4], size=(2000, 2000))
    end = time.monotonic()
    is_done.set()
    thread.join()
    # Without the lock of the interpreter, the other thread would not have run at all in between.
    assert sum(begin < tick < end for tick in ticks) >= 3


@posix
@pytest.mark.parametrize("what", ["load", "mesh", "render", "build", "cast", "cameras"])
def test_interrupts_end_work_that_would_take_minutes(what, tmp_path):
    ran = subprocess.run(
        [sys.executable, "-c", INTERRUPTED, what, str(tmp_path)],
        capture_output=True,
        text=True,
        timeout=120,
        cwd=os.path.dirname(__file__),
    )
    assert ran.returncode == 0, ran.stderr
    print(what, ran.stdout)


INTERRUPTED = textwrap.dedent(
    """
    import os, signal, sys, threading, time
    import numpy as np
    import feimos
    from test_threads import soup

    def interrupt():
        time.sleep(0.3)
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    what, folder = sys.argv[1:]
    pipe = os.path.join(folder, "pipe.pbrt")
    # Nobody writes into it: reading waits for ever.
    os.mkfifo(pipe)
    sent = []
    scene = soup(4_000)
    many = np.zeros((400_000, 3), dtype=np.uint32) + [0, 1, 2]
    k = [[900, 0, 999], [0, 900, 999], [0, 0, 1]]
    work = {
        "load": lambda: feimos.load(pipe),
        "cameras": lambda: scene.cameras(pipe),
        "mesh": lambda: [feimos.mesh(np.zeros((3, 3)), many) for _ in range(100_000)],
        "render": lambda: scene.render(
            k, t=[0, 0, 4], size=(2000, 2000), channels="cost", accel="none"
        ),
        "build": lambda: [soup(300_000).render(accel="sah") for _ in range(1_000)],
        "cast": lambda: [scene.cast(np.zeros((5_000_000, 3)), [0, 0, 1]) for _ in range(1_000)],
    }[what]
    threading.Thread(target=interrupt).start()
    try:
        work()
        sys.exit("not interrupted")
    except KeyboardInterrupt:
        print(f"{1000 * (time.monotonic() - sent[0]):.0f} ms")
    if what not in ("load", "cameras"):
        # The threads that were interrupted work again.
        small = feimos.load("../../scenes/sphere.pbrt", resolution=(20, 20))
        assert np.isfinite(small.render()["Z"]).any()
    # A thread that waits for the pipe does not hold up the end.
    """
)


@posix
def test_handlers_of_the_user_run_and_may_go_on():
    calls = []
    old = signal.signal(signal.SIGALRM, lambda *_: calls.append(1))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.03, 0.03)
        scene = soup(300)
        k = [[300, 0, 299], [0, 300, 299], [0, 0, 1]]
        while len(calls) < 3:
            scene.render(k, t=[0, 0, 4], size=(600, 600), channels="cost", accel="none")
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, old)


def test_threads_share_a_scene():
    scene = feimos.load(SCENES / "quadrics.pbrt", resolution=SIZE)
    expected = scene.render(channels=("Z", "prim"))
    rays = scene.camera.rays()
    hits = feimos.load(SCENES / "quadrics.pbrt").cast(*rays)

    def work(number: int) -> bool:
        image = scene.render(channels=("Z", "prim"), threads=1 + number % 3)
        found = scene.cast(*rays)
        return all(same(image[name], expected[name]) for name in expected) and all(
            same(found[name], hits[name]) for name in hits
        )

    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(work, range(48)))


@pytest.mark.parametrize("threads", [1, 2, 3, 17, 64])
def test_the_number_of_threads_does_not_matter(threads):
    expected = depth(0)
    scene = feimos.load(SCENES / "quadrics.pbrt", resolution=SIZE, threads=threads)
    assert same(scene.render(threads=threads)["Z"], expected)
    rays = scene.camera.rays()
    assert same(scene.cast(*rays, threads=threads)["t"], expected)


@pytest.mark.parametrize(
    "method",
    [pytest.param("fork", marks=posix), pytest.param("forkserver", marks=posix), "spawn"],
)
@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
def test_processes(method):
    # Threads have already worked here: a fork has none of them.
    expected = depth(0)
    with multiprocessing.get_context(method).Pool(2) as pool:
        images = pool.map_async(depth, range(4)).get(timeout=60)
    assert all(same(image, expected) for image in images)


@posix
@pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")
def test_a_fork_inherits_a_scene():
    scene = feimos.mesh(POINTS, TRIANGLES)
    expected, hit = scene.render()["Z"], scene.cast([0.1, 0.1, -2], [0, 0, 1])["t"]
    child = os.fork()
    if child == 0:
        is_same = same(scene.render()["Z"], expected)
        is_same &= bool(scene.cast([0.1, 0.1, -2], [0, 0, 1])["t"] == hit)
        rays = np.zeros((1000, 3)) + [0.1, 0.1, -2]
        is_same &= bool((scene.cast(rays, [0, 0, 1])["t"] == hit).all())
        os._exit(0 if is_same else 1)
    end = time.monotonic() + 60
    while time.monotonic() < end:
        done, status = os.waitpid(child, os.WNOHANG)
        if done:
            assert status == 0
            return
        time.sleep(0.01)
    os.kill(child, signal.SIGKILL)
    pytest.fail("the child hangs")
