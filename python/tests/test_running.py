"""Progress, interrupts, threads, and what they leave behind."""

import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import abut
from shapes import box, grid, matrix, random_poses, sphere


def long_query(progress=None):
    """Some 10^10 pairs of triangles, all of which meet."""
    fan = long_query.model
    return abut.collide(fan, None, fan, None, mode="all", segments=True, progress=progress)


@pytest.fixture(scope="module", autouse=True)
def fan():
    angles = np.linspace(0, 2 * np.pi, 60001)
    rim = np.stack([np.cos(angles), np.sin(angles), np.zeros_like(angles)], axis=1)
    n = len(rim)
    faces = np.stack([np.full(n - 1, n), np.arange(n - 1), np.arange(1, n)], axis=1)
    long_query.model = abut.Model(np.concatenate([rim, [[0, 0, 0]]]), faces)


def interrupt_after(seconds):
    timer = threading.Timer(seconds, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    return timer


def test_interrupt_stops_a_query_and_leaves_nothing():
    before = signal.getsignal(signal.SIGINT)
    for _ in range(2):
        timer = interrupt_after(0.3)
        start = time.monotonic()
        with pytest.raises(KeyboardInterrupt):
            long_query()
        timer.join()
        assert time.monotonic() - start < 20
    assert signal.getsignal(signal.SIGINT) is before
    model = abut.Model(*box())
    assert abut.collide(model, None, model, None).meet
    with pytest.raises(KeyboardInterrupt):  # Python's own handler is back
        os.kill(os.getpid(), signal.SIGINT)
        time.sleep(1)


def test_handler_that_does_not_raise():
    seen = []
    before = signal.signal(signal.SIGINT, lambda *_: seen.append(1))
    try:
        timer = interrupt_after(0.3)
        with pytest.raises(abut.Error) as error:
            long_query()
        timer.join()
        assert error.value.code is abut.ErrorCode.interrupted and seen
    finally:
        signal.signal(signal.SIGINT, before)


def test_world_after_interrupt():
    world = abut.World()
    a, b = world.add(long_query.model), world.add(long_query.model, matrix((0, 0, 1e-9), (1, 1e-3, 0, 0)))
    timer = interrupt_after(0.2)
    try:
        world.penetration()
    except KeyboardInterrupt:
        pass
    timer.cancel()
    world.remove(b)
    assert world.collide().tolist() == [] and len(world) == 1


def test_progress():
    model = abut.Model(*sphere(20))
    poses = random_poses(np.random.default_rng(1), 2000, 1.0)
    seen = []
    abut.distance(model, None, model, poses, progress=lambda stage, fraction: seen.append((stage, fraction)))
    assert seen and all(isinstance(s, str) and 0 <= f <= 1 for s, f in seen)
    fractions = [f for _, f in seen]
    assert fractions == sorted(fractions)


def test_progress_that_raises():
    model = abut.Model(*sphere(20))
    poses = random_poses(np.random.default_rng(1), 5000, 1.0)

    def stop(stage, fraction):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        abut.distance(model, None, model, poses, progress=stop)
    with pytest.raises(TypeError):
        abut.distance(model, None, model, poses, progress=3)


def test_models_that_are_stopped():
    vertices, faces = grid(300)
    timer = interrupt_after(0.2)
    with pytest.raises(KeyboardInterrupt):
        while True:
            abut.Model(vertices, faces)
    timer.join()


def test_queries_of_many_threads():
    model = abut.Model(*sphere(12))
    poses = random_poses(np.random.default_rng(2), 200, 1.5)
    expected = abut.distance(model, None, model, poses).distance
    failures = []

    def work():
        for pose, distance in zip(poses, expected):
            if abut.distance(model, None, model, pose).distance != distance:
                failures.append(pose)

    threads = [threading.Thread(target=work) for _ in range(4)]
    [t.start() for t in threads]
    [t.join() for t in threads]
    assert not failures


def test_the_lock_is_released():
    ticks, done = [], threading.Event()

    def tick():
        while not done.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.005)

    thread = threading.Thread(target=tick)
    thread.start()
    timer = interrupt_after(0.5)
    start = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        long_query()
    end = time.monotonic()
    done.set()
    thread.join()
    timer.join()
    assert len([t for t in ticks if start < t < end]) > 5


def test_one_thread_changes_a_deformable():
    vertices, faces = grid(120)
    cloth = abut.Deformable(vertices, faces)
    rng = np.random.default_rng(3)
    cloth.set_motion(vertices, vertices + rng.uniform(-0.05, 0.05, vertices.shape))
    running = threading.Event()
    errors = []

    def query():
        running.set()
        abut.self_impacts(cloth)

    thread = threading.Thread(target=query)
    thread.start()
    running.wait()
    while thread.is_alive():
        try:
            cloth.advance(vertices)
        except RuntimeError as error:
            errors.append(str(error))
            time.sleep(0.001)
    thread.join()
    assert all("in use" in e for e in errors)


def test_a_child_of_fork_queries():
    model = abut.Model(*box())
    abut.collide(model, None, model, None)
    child = os.fork()
    if child == 0:
        os._exit(0 if abut.collide(model, None, model, None).meet else 1)
    assert os.waitpid(child, 0)[1] == 0


def test_interpreter_ends_after_queries():
    code = ("import abut, numpy as np; m = abut.Model(np.eye(3), [[0, 1, 2]]); w = abut.World(filter=lambda a, b: True);"
            "w.add(m); w.add(m); print(len(w.collide()), abut.distance(m, None, m, None).distance)")
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert result.returncode == 0 and result.stdout.split() == ["1", "0.0"] and not result.stderr
