"""How the package behaves: exceptions, signals, threads, memory."""

import gc
import os
import signal
import sys
import threading
import time

import numpy as np
import pytest

import heightlight as hl


def test_exceptions_are_pythons_and_name_no_option(brick, brick_operator):
    cases = [
        (ValueError, lambda: hl.sky(brick, error=2)),
        (ValueError, lambda: hl.sky(brick, error=-1)),
        (ValueError, lambda: hl.sky(brick, error="small")),
        (ValueError, lambda: hl.sky(brick, azimuths=7).sky_view_factor),
        (ValueError, lambda: hl.sky(brick, rays=70000)),
        (ValueError, lambda: hl.sky(brick, rays=8).bent_normal),
        (ValueError, lambda: hl.sky(brick, falloff="soft")),
        (ValueError, lambda: hl.sky(brick, max_distance=-1).sky_view_factor),
        (ValueError, lambda: hl.sky(brick, boundary="round")),
        (ValueError, lambda: hl.sky(brick, threads=0)),
        (ValueError, lambda: hl.sky(brick, seed=-1)),
        (ValueError, lambda: hl.sky(brick).horizons(0)),
        (ValueError, lambda: hl.sky(brick).horizons([np.nan])),
        (ValueError, lambda: hl.sky(np.full((4, 4), np.nan))),
        (ValueError, lambda: hl.sky(np.full((4, 4), np.inf))),
        (ValueError, lambda: hl.sky(np.zeros((0, 4)))),
        (ValueError, lambda: hl.sky(np.zeros(4))),
        (ValueError, lambda: hl.sky(np.zeros((2, 2, 2)))),
        (ValueError, lambda: hl.sky(np.array([[1, "a"]], dtype=object))),
        (ValueError, lambda: hl.sky(np.zeros((3, 3), dtype=complex))),
        (ValueError, lambda: hl.sky([[1, 2], [3]])),
        (ValueError, lambda: brick_operator.solve(1.5)),
        (ValueError, lambda: brick_operator.solve(np.zeros((3, 3)))),
        (ValueError, lambda: brick_operator.solve([0.1, 0.2])),
        (ValueError, lambda: brick_operator.solve(0.5, np.full(brick_operator.shape, -1.0))),
        (ValueError, lambda: brick_operator.solve(0.5, np.zeros((2, 2)))),
        (ValueError, lambda: brick_operator @ np.zeros((2, 2))),
        (ValueError, lambda: brick_operator @ np.full(brick_operator.shape, np.inf)),
        (ValueError, lambda: brick_operator.bounces(0)),
        (ValueError, lambda: brick_operator.curves(bins=0)),
        (ValueError, lambda: hl.bake(brick, "oa")),
        (ValueError, lambda: hl.bake(brick, [])),
        (ValueError, lambda: hl.bake(brick).save("/tmp", depth=7)),
        (ValueError, lambda: hl.compare(brick, albedo=2)),
        (ValueError, lambda: hl.compare(brick, sky=np.zeros((3, 3, 3)))),
        (ValueError, lambda: hl.fit([])),
        (ValueError, lambda: hl.dataset([brick], relief_shares=[0])),
        (MemoryError, lambda: hl.sky(brick, memory=1000).sky_view_factor),
        (MemoryError, lambda: hl.operator(brick, memory=1000)),
        (OSError, lambda: hl.bake(brick).save("/proc/nowhere")),
        (OSError, lambda: hl.read_sky("/nowhere.hdr")),
    ]
    for kind, call in cases:
        with pytest.raises(kind) as raised:
            call()
        message = str(raised.value)
        assert message and "--" not in message and "\n" not in message, message


def test_arguments_are_fuzzed():
    """Exceptions only, whatever comes: 10^4 calls."""
    random = np.random.default_rng(7)
    dtypes = ["f4", "f8", ">f4", ">f8", "i1", "u2", ">i4", "f2", "?", "c8", "O", "U3", "M8[s]"]
    refused = taken = 0
    for _ in range(10_000):
        shape = tuple(int(side) for side in random.integers(0, 5, random.integers(0, 4)))
        values = random.choice([0.0, 1.0, -3.0, 1e30, np.nan, np.inf, 1e-40], shape) if random.random() < 0.7 else random.random(shape)
        with np.errstate(all="ignore"):
            try:
                heights = np.asarray(values).astype(random.choice(dtypes))
            except (TypeError, ValueError):
                heights = None
        if heights is not None and heights.ndim == 2 and random.random() < 0.3:
            heights = heights[::-1, ::2]
        if heights is not None and random.random() < 0.2:
            heights.setflags(write=False)
        texel = random.choice([1.0, 0.0, -1.0, np.nan, 1e-30, 1e30]) if random.random() < 0.5 else None
        try:
            with np.errstate(all="ignore"):
                sky = hl.sky(heights, texel=texel, boundary=random.choice(["tile", "open", "wrap"], p=[0.45, 0.45, 0.1]), rays=4, threads=1)
                found = sky.sky_view_factor
            assert found.shape == heights.shape
            assert np.all((found >= 0) & (found <= 1) | np.isnan(found))
            taken += 1
        except (ValueError, MemoryError, OSError) as fault:
            assert str(fault)
            refused += 1
    assert taken > 500 and refused > 500


def test_nothing_leaks(brick):
    heights = hl.synth("brick", 16).height
    light = np.ones((16, 16))

    def once():
        op = hl.operator(heights, boundary="open", rays=16, threads=1)
        op.solve(0.5)
        op @ light
        hl.forms.cubic(light, 0.5)
        hl.sky(heights, boundary="open", error=0.05, threads=1).sky_view_factor
        with pytest.raises(ValueError):
            hl.sky(heights, error=2)

    def resident():
        with open("/proc/self/statm") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    for _ in range(100):
        once()
    gc.collect()
    before, references = resident(), (sys.getrefcount(heights), sys.getrefcount(light))
    for _ in range(1000):
        once()
    gc.collect()
    assert (sys.getrefcount(heights), sys.getrefcount(light)) == references
    assert resident() - before < 8 << 20  # of 1000 operators of some 100 KB


def test_ctrl_c_stops_within_a_second():
    heights = hl.synth("fbm", 512)
    for work in (lambda: hl.operator(heights, rays=4000), lambda: hl.sky(heights, error=0, azimuths=1024).sky_view_factor):
        timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        with pytest.raises(KeyboardInterrupt):
            work()
        sent = timer.finished.is_set()
        assert sent
    start = time.monotonic()
    timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        hl.operator(heights, rays=4000)
    assert time.monotonic() - start < 0.5 + 5  # a second, on a machine that may be busy


def test_others_run_meanwhile():
    """The interpreter's lock is free: a thread counts while another solves."""
    done = threading.Event()

    def solve():
        hl.operator(hl.synth("fbm", 256), error=1e-3).solve(0.8)
        done.set()

    thread = threading.Thread(target=solve)
    thread.start()
    laps = 0
    while not done.is_set():
        time.sleep(1e-3)
        laps += 1
    thread.join()
    assert laps > 20


def test_two_threads_may_solve_at_once(brick_operator):
    expected = [brick_operator.solve(albedo) for albedo in (0.3, 0.8)]
    found = [None, None]

    def solve(i):
        for _ in range(3):
            found[i] = brick_operator.solve((0.3, 0.8)[i])

    threads = [threading.Thread(target=solve, args=(i,)) for i in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for one, other in zip(expected, found):
        np.testing.assert_array_equal(one, other)


def test_progress_is_told(brick):
    steps = []
    hl.operator(brick, progress=lambda name, done, total, ended: steps.append((name, done, total, ended)))
    assert steps and steps[-1][3]
    assert hl.sky(brick, progress=True).sky_view_factor.size  # with tqdm, or without

    def fail(*_):
        raise RuntimeError("seen enough")

    with pytest.raises(RuntimeError, match="seen enough"):
        hl.operator(brick, progress=fail)

    def fail_at_the_end(name, done, total, ended):
        if ended:
            raise RuntimeError("too late to stop")

    with pytest.raises(RuntimeError, match="too late"):
        hl.sky(brick, progress=fail_at_the_end).sky_view_factor


def test_help_reads_well():
    for thing in (hl, hl.sky, hl.operator, hl.Operator.solve, hl.bake, hl.judge, hl.forms, hl.forms.cubic, hl.Sky.sky_view_factor):
        assert thing.__doc__ and len(thing.__doc__) > 40
    assert hl.__version__.count(".") == 2
    for name in hl.__all__:
        assert getattr(hl, name).__doc__
