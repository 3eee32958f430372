"""scene.npz and scene.csv as numpy reads them, against scene.glb and the report."""

import csv
import io
import zipfile

import numpy as np
import pytest

import retarget

from glb_file import Glb
from test_clips import forward


@pytest.fixture(scope="module")
def result():
    import conftest

    hold = [str(conftest.HOLD / name) for name in ("a.bvh", "b.bvh", "template.yaml")]
    return retarget.run(*hold, {"solve.threads": 1}, frames=(0, 40), page=False,
                        also=["npz", "csv"])


@pytest.fixture(scope="module")
def scene(result):
    with np.load(io.BytesIO(result.files["scene.npz"]), allow_pickle=False) as arrays:
        return {name: arrays[name] for name in arrays.files}


def scene_positions(glb):
    """World positions of a scene.glb's nodes at its keys, by the rules of glTF: {name: [T, 3]}."""
    file = Glb(glb)
    gltf, accessor = file.json, file.accessor

    nodes, animation = gltf["nodes"], gltf["animations"][0]
    frames = len(accessor(animation["samplers"][0]["input"]))
    order, parents = [], []

    def visit(node, parent):
        order.append(node)
        parents.append(parent)
        at = len(order) - 1
        for child in nodes[node].get("children", []):
            visit(child, at)

    for root in gltf["scenes"][0]["nodes"]:
        visit(root, -1)
    rotations = np.tile(np.array([0.0, 0, 0, 1]), (frames, len(order), 1))
    translations = np.zeros((frames, len(order), 3))
    for k, node in enumerate(order):
        rotations[:, k] = nodes[node].get("rotation", [0, 0, 0, 1])
        translations[:, k] = nodes[node].get("translation", [0, 0, 0])
    for channel in animation["channels"]:
        values = accessor(animation["samplers"][channel["sampler"]]["output"])
        target = {"rotation": rotations, "translation": translations}[channel["target"]["path"]]
        target[:, order.index(channel["target"]["node"])] = values
    # Several trees: each root is its own.
    world = forward({"rotations": rotations, "translations": translations, "parents": parents})
    times = accessor(animation["samplers"][0]["input"])[:, 0]
    return {nodes[n].get("name"): world[:, k] for k, n in enumerate(order)}, times


def test_positions_are_those_of_the_scene_file(result, scene):
    written, times = scene_positions(result.files["scene.glb"])
    checked = 0
    for figure in "ab":
        for j, node in enumerate(scene["nodes"]):
            difference = written[f"{figure}/{node}"] - scene[f"{figure}_positions"][:, j]
            assert np.linalg.norm(difference, axis=1).max() < 1e-4  # m
            checked += len(difference)
    assert checked == 2 * 21 * 40
    assert np.abs(times - np.arange(40) / scene["mocap_framerate"]).max() < 0.01


def test_rotations_say_the_same_three_times(scene):
    for figure in "ab":
        q = scene[f"{figure}_rotations"].reshape(-1, 4)
        x, y, z, w = q.T
        matrices = np.stack(
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
             2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
             2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], -1,
        ).reshape(-1, 3, 3)
        six = scene[f"{figure}_rotations_6d"].reshape(-1, 6)
        assert np.abs(six[:, :3] - matrices[:, :, 0]).max() < 1e-12
        assert np.abs(six[:, 3:] - matrices[:, :, 1]).max() < 1e-12
        vectors = scene[f"{figure}_poses"].reshape(-1, 3)
        angle = np.linalg.norm(vectors, axis=1)
        assert angle.max() <= np.pi + 1e-12
        half = np.where(angle[:, None] > 1e-12, vectors * (np.sin(angle / 2) /
                        np.maximum(angle, 1e-300))[:, None], vectors / 2)
        again = np.concatenate([half, np.cos(angle / 2)[:, None]], 1)
        assert np.abs(np.abs((again * q).sum(1)) - 1).max() < 1e-12


def test_shapes_names_contacts_and_tags(result, scene):
    frames, nodes, links = 40, len(scene["nodes"]), len(scene["links"])
    assert (nodes, links) == (21, 19)
    report = result.report
    assert scene["tag_gli"].shape == (frames, len(report["tangles"]))
    for k, tangle in enumerate(report["tangles"]):
        assert abs(scene["tag_gli"][:, k].min() - tangle["min_signed_gli"]) < 1e-9
        assert tangle["a"][0] in scene["tags"][k] and tangle["b"][1] in scene["tags"][k]
    for figure in "ab":
        shapes = {name: scene[f"{figure}_{name}"].shape for name in
                  ("positions", "rotations", "rotations_6d", "poses", "trans", "contacts")}
        assert shapes == {
            "positions": (frames, nodes, 3), "rotations": (frames, links, 4),
            "rotations_6d": (frames, links, 6), "poses": (frames, 3 * links),
            "trans": (frames, 3), "contacts": (frames, nodes),
        }
        contacts = np.zeros((frames, nodes), bool)
        for contact in report["contacts"][figure]:
            node = list(scene["nodes"]).index(contact["node"])
            contacts[contact["first"] : contact["last"] + 1, node] = True
        assert (scene[f"{figure}_contacts"] == contacts).all()
        radii = report["bodies"][figure]["radius"]
        for node, radius in radii.items():
            assert abs(scene[f"{figure}_radii"][list(scene["nodes"]).index(node)] - radius) < 1e-9
    assert scene["a_contacts"].any() or scene["b_contacts"].any()


def test_the_archive_is_whole_and_the_same_every_time(result, scene):
    data = result.files["scene.npz"]
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert archive.testzip() is None
        assert all(info.compress_type == zipfile.ZIP_STORED for info in archive.infolist())
        assert len(archive.infolist()) == len(scene)


def test_csv_is_the_same_scene(result, scene):
    rows = list(csv.DictReader(io.StringIO(result.files["scene.csv"].decode())))
    assert len(rows) == 40
    for t in (0, 17, 39):
        for figure in "ab":
            for j, node in enumerate(scene["nodes"]):
                point = [float(rows[t][f"{figure}/{node}.{axis}"]) for axis in "xyz"]
                assert (np.array(point) == scene[f"{figure}_positions"][t, j]).all()
        assert float(rows[t]["tag_1"]) == scene["tag_gli"][t, 0]


def test_other_kinds_are_refused(hold):
    with pytest.raises(retarget.InputError, match="also obj: expected some of npz, csv"):
        retarget.run(*hold, also=["obj"])
    with pytest.raises(retarget.InputError, match="twice"):
        retarget.run(*hold, also=["npz", "npz"])
