"""Clips to arrays and back; the stubs say what there is."""

import ast
import inspect
import pathlib

import numpy as np
import pytest

import retarget


def forward(clip):
    """World positions [T, J, 3] of a dict of Clip.arrays, by the definition."""
    rotations, translations = clip["rotations"], clip["translations"]
    world_r, world_p = [], []
    for j, parent in enumerate(clip["parents"]):
        x, y, z, w = np.moveaxis(rotations[:, j], -1, 0)
        local = np.stack(
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
             2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
             2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], -1,
        ).reshape(-1, 3, 3)
        if parent < 0:
            world_r.append(local)
            world_p.append(translations[:, j])
        else:
            world_r.append(world_r[parent] @ local)
            world_p.append(
                world_p[parent] + np.einsum("tij,tj->ti", world_r[parent], translations[:, j])
            )
    return np.stack(world_p, 1)


def rebuilt(arrays, **more):
    return retarget.clip_from_arrays(
        arrays["names"], arrays["parents"], arrays["offsets"], arrays["rotations"],
        arrays["translations"][:, 0], arrays["fps"], **more,
    )


def test_a_clip_out_of_its_own_arrays_is_the_same_motion(hold):
    arrays = retarget.Clip(hold[0]).arrays()
    again = rebuilt(arrays).arrays()
    assert sorted(again["names"]) == sorted(arrays["names"])
    assert abs(again["fps"] - arrays["fps"]) < 1e-6
    order = [again["names"].index(name) for name in arrays["names"]]
    one, other = forward(arrays), forward(again)[:, order]
    assert np.abs(one - other).max() < 1e-6 * np.abs(one).max()


def test_any_rotation_comes_back_gimbal_locks_included():
    rng = np.random.default_rng(3)
    rotations = rng.normal(size=(200, 2, 4))
    half = np.sqrt(0.5)
    rotations[0] = [half, 0, 0, half]  # x by a quarter: Rz and Ry are one axis
    rotations[1] = [-half, 0, 0, half]
    rotations[2] = np.array([[0.5, 0.5, 0.5, 0.5], [0.5, -0.5, 0.5, 0.5]])
    rotations /= np.linalg.norm(rotations, axis=-1, keepdims=True)
    clip = retarget.clip_from_arrays(
        ["root", "tip"], [-1, 0], [[0, 0, 0], [0, 1, 0]], rotations, np.zeros((200, 3)), 30,
        end_sites={"tip": [0, 0.5, 0]},
    )
    back = clip.arrays()["rotations"]
    same = np.abs(np.einsum("tjk,tjk->tj", back, rotations))  # q and -q are one
    assert same.min() > 1 - 1e-12


def test_a_clip_out_of_arrays_is_solved_like_its_file(hold):
    ends = {}
    for line in open(hold[0]).read().splitlines():
        words = line.split()
        if words[:1] in (["JOINT"], ["ROOT"]):
            joint = words[1]
        elif words[:2] == ["End", "Site"]:
            joint, at_end = joint, True
        elif words[:1] == ["OFFSET"] and locals().get("at_end"):
            ends[joint], at_end = [float(w) for w in words[1:]], False
    arrays = retarget.Clip(hold[0]).arrays()
    clip = rebuilt(arrays, end_sites=ends, units="cm")
    settings = {"solve.threads": 1}
    one = retarget.run(hold[0], hold[1], hold[2], settings, frames=(0, 10), page=False)
    other = retarget.run(clip, hold[1], hold[2], settings, frames=(0, 10), page=False)
    difference = one.solved["a"].positions - other.solved["a"].positions
    assert np.abs(difference).max() < 1e-4


@pytest.mark.parametrize(
    "change, message",
    [
        (dict(parents=[-1, 1]), "parents"),
        (dict(parents=[-1, -1]), "parents"),
        (dict(names=["a b", "c"]), "names"),
        (dict(offsets=[[0, 0, 0]]), "offsets"),
        (dict(root=[[0, 0]]), "root"),
        (dict(rotations=np.full((1, 2, 4), np.nan)), "rotations"),
        (dict(end_sites={"x": [0, 0, 0]}), "end_sites"),
    ],
)
def test_arrays_that_are_no_clip_are_refused(change, message):
    words = dict(names=["a", "b"], parents=[-1, 0], offsets=np.zeros((2, 3)),
                 rotations=np.tile([0.0, 0, 0, 1], (1, 2, 1)), root=np.zeros((1, 3)), fps=30)
    words.update(change)
    with pytest.raises(retarget.InputError, match=message):
        retarget.clip_from_arrays(**words)


def test_the_stubs_name_what_there_is():
    stubs = ast.parse(pathlib.Path(retarget.__file__).with_name("__init__.pyi").read_text())
    said = {}
    for node in stubs.body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            members = [n.name for n in getattr(node, "body", []) if isinstance(n, ast.FunctionDef)]
            said[node.name] = members
    public = set(retarget.__all__) - {"__version__"}
    assert set(said) == public
    for name, members in said.items():
        value = getattr(retarget, name)
        assert name == "InputError" or inspect.getdoc(value), f"{name} has no docstring"
        if inspect.isclass(value) and name != "InputError":
            there = {n for n, v in vars(value).items() if not n.startswith("_")}
            assert there == {m for m in members if not m.startswith("_")}, name
