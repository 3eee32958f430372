"""retarget.run against the command line, and how it shares the interpreter."""

import json
import os
import signal
import threading
import time

import numpy as np
import pytest

import retarget

from glb_file import Glb

SETTINGS = {"solve.threads": 1, "weights": {"tangle": 30}}


def run(hold, **more):
    return retarget.run(*hold, SETTINGS, frames=(0, 30), page=False, **more)


def test_equals_the_command_line_to_the_last_bit(hold, program):
    a, b, template = hold
    out = program("--clip-a", a, "--clip-b", b, "--template", template, "--frames", "0:30",
                  "--threads", "1", "--set", "weights.tangle=30")
    result = run(hold)
    files = result.files
    for name in ("scene.glb", "source.glb", "baseline.glb", "a.bvh", "b.bvh", "config.yaml"):
        assert files[name] == (out / name).read_bytes(), name
    report = json.loads((out / "report.json").read_text())
    assert result.metrics == report["metrics"]["result"]
    assert result.report["requirements"] == report["requirements"]
    assert result.exit_code == report["exit_code"]
    assert result.status == ("solved" if result.exit_code == 0 else "requirement_missed")


def test_bytes_and_paths_and_objects_are_one(hold, tmp_path):
    a, b, template = hold
    text = open(template).read()
    by_bytes = retarget.run(open(a, "rb").read(), retarget.Clip(b), retarget.Template(text),
                            SETTINGS, frames=(0, 30), page=False)
    assert by_bytes.files["scene.glb"] == run(hold).files["scene.glb"]
    by_bytes.save(tmp_path / "out")
    assert (tmp_path / "out" / "scene.glb").read_bytes() == by_bytes.files["scene.glb"]


def test_arrays_are_views_of_the_scene(hold):
    result = run(hold)
    file = Glb(result.files["scene.glb"])
    scene, accessor = file.json, file.accessor

    checked = 0
    for figure in "ab":
        motion = result.solved[figure]
        assert motion.positions.shape == (30, 21, 3) == (len(motion), len(motion.nodes), 3)
        assert motion.rotations.shape == (30, len(motion.links), 4)
        assert np.allclose(np.linalg.norm(motion.rotations, axis=-1), 1)
        assert np.allclose(motion.positions[:, motion.nodes.index("root")], motion.root)
        assert not motion.positions.flags.writeable and not motion.positions.flags.owndata
        with pytest.raises(ValueError):
            motion.positions[0, 0, 0] = 1
        for channel in scene["animations"][0]["channels"]:
            name = scene["nodes"][channel["target"]["node"]]["name"]
            sampler = scene["animations"][0]["samplers"][channel["sampler"]]
            if name == f"{figure}/root" and channel["target"]["path"] == "translation":
                assert np.abs(accessor(sampler["output"]) - motion.root).max() < 1e-6
                assert np.allclose(accessor(sampler["input"])[:, 0], np.arange(30) / motion.fps)
                checked += 1
    assert checked == 2
    for motions in (result.source, result.baseline):
        assert motions["b"].positions.shape == (30, 21, 3)
    view = result.solved["a"].positions  # outlives what it looks into
    expected = view.copy()
    del result, motion, motions
    assert (view == expected).all()


def test_other_threads_run_meanwhile(hold):
    count, stop = [0], threading.Event()

    def work():
        while not stop.is_set():
            count[0] += 1

    thread = threading.Thread(target=work)
    thread.start()
    try:
        before = count[0]
        run(hold)  # one step of the interpreter: who does not let go lets nobody count
        during = count[0] - before
    finally:
        stop.set()
        thread.join()
    assert during > 100_000


def test_ctrl_c_ends_the_solve(hold):
    iterations = []

    def progress(iteration):
        iterations.append(iteration)
        if len(iterations) == 2:
            os.kill(os.getpid(), signal.SIGINT)

    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        run(hold, progress=progress)
    assert 2 <= len(iterations) <= 3
    assert time.monotonic() - begin < 60
    assert set(iterations[0]) == {"stage", "iteration", "cost", "step_m", "smallest_gli",
                                  "penetration_m", "hold_m", "seconds"}


def test_progress_stops_and_its_errors_arrive(hold):
    assert run(hold, progress=lambda iteration: False).status == "interrupted"

    def broken(iteration):
        raise RuntimeError("mine")

    with pytest.raises(RuntimeError, match="mine"):
        run(hold, progress=broken)


@pytest.mark.parametrize(
    "arguments, message",
    [
        (dict(settings={"weights.tangel": 3}), 'did you mean "weights.tangle"'),
        (dict(settings={"weights": {"tangle": "much"}}), "weights.tangle"),
        (dict(clip_a="/nowhere.bvh"), "/nowhere.bvh"),
        (dict(template="/nowhere.yaml"), "/nowhere.yaml"),
        (dict(frames=(5, 2)), "frames 5:2"),
        (dict(template_at=1000), "template_at 1000"),
        (dict(fps=0), "fps 0"),
        (dict(show="all"), "show: expected"),
    ],
)
def test_refusals_are_one_line(hold, arguments, message):
    words = dict(clip_a=hold[0], clip_b=hold[1], template=hold[2])
    words.update(arguments)
    with pytest.raises(retarget.InputError) as refusal:
        retarget.run(**words)
    assert message in str(refusal.value) and "\n" not in str(refusal.value)
    assert isinstance(refusal.value, ValueError)


def test_options_of_clips(hold):
    with pytest.raises(retarget.InputError, match='did you mean "stature"'):
        retarget.Clip(hold[0], statur=1.8)
    with pytest.raises(retarget.InputError, match="units parsec"):
        retarget.run(retarget.Clip(hold[0], units="parsec"), hold[1], hold[2])
    tall = retarget.run(retarget.Clip(hold[0], stature=1.9), hold[1], hold[2], SETTINGS,
                        frames=(0, 4), page=False)
    assert abs(tall.report["bodies"]["a"]["stature_m"] - 1.9) < 1e-6
