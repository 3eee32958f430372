"""The add-on as an artist uses it, without a window.

    RETARGET_BINARY=... blender --background --factory-startup --python-exit-code 1 \\
        --python addon_test.py -- SOURCE_DIR ADDON.zip WORK_DIR

Two armatures, the operator called, the joints of the result against scene.glb; writes
WORK_DIR/result.json with what was measured.
"""
import builtins
import json
import pathlib
import sys

import bpy
import numpy
from mathutils import Matrix, Quaternion, Vector

if "bool" not in vars(numpy):
    numpy.bool = bool
_open = builtins.open
builtins.open = lambda file, mode="r", *rest, **named: _open(
    file, mode.replace("U", ""), *rest, **named
)

SOURCE, ADDON, WORK = map(pathlib.Path, sys.argv[sys.argv.index("--") + 1 :])
sys.path.insert(0, str(SOURCE / "tests"))
from glb_file import Glb  # noqa: E402
HOLD = SOURCE / "data" / "holds" / "bear_hug"
FRAMES = 40
FIRST = 11  # of the scene

NODES = {  # of the shipped clips' rigs
    "Hips": "root", "LeftForeArm": "left_elbow", "LeftHand": "left_wrist",
    "RightForeArm": "right_elbow", "RightHand": "right_wrist", "LeftLeg": "left_knee",
    "LeftFoot": "left_ankle", "RightLeg": "right_knee", "RightFoot": "right_ankle",
    "LeftUpLeg": "left_hip", "RightUpLeg": "right_hip", "LeftArm": "left_shoulder",
    "RightArm": "right_shoulder", "Head": "head", "Neck": "neck",
}


def armature(name, offset):
    path = HOLD / f"{name}.bvh"
    bpy.ops.import_anim.bvh(filepath=str(path), axis_forward="-Z", axis_up="Y",
                            use_fps_scale=False, frame_start=FIRST, global_scale=0.01)
    thing = bpy.context.object
    thing.name = f"figure {name}"
    # Placed, turned and scaled as artists do.
    thing.location = offset
    thing.rotation_euler = (0, 0, 0.7)
    return thing


def snapshot(action):
    return [(c.data_path, c.array_index, [tuple(p.co) for p in c.keyframe_points])
            for c in action.fcurves]


def heads(thing):
    return {b.name: thing.matrix_world @ b.head for b in thing.pose.bones}


def glb_positions(path):
    """{node: [position per key]} by the rules of glTF, in Blender's axes."""
    file = Glb(path.read_bytes())
    gltf, accessor = file.json, file.accessor

    tracks = {}
    for channel in gltf["animations"][0]["channels"]:
        sampler = gltf["animations"][0]["samplers"][channel["sampler"]]
        key = (channel["target"]["node"], channel["target"]["path"])
        tracks[key] = accessor(sampler["output"])
        frames = len(tracks[key])
    out = {}

    def visit(index, parent, frame):
        node = gltf["nodes"][index]
        t = tracks.get((index, "translation"))
        r = tracks.get((index, "rotation"))
        t = t[frame] if t is not None else node.get("translation", [0, 0, 0])
        r = r[frame] if r is not None else node.get("rotation", [0, 0, 0, 1])
        local = (Matrix.Translation([float(x) for x in t])
                 @ Quaternion((float(r[3]), *(float(x) for x in r[:3]))).to_matrix().to_4x4())
        world = parent @ local
        p = world.translation
        out.setdefault(node.get("name"), []).append(Vector((p.x, -p.z, p.y)))
        for child in node.get("children", []):
            visit(child, world, frame)

    for frame in range(frames):
        for root in gltf["scenes"][0]["nodes"]:
            visit(root, Matrix.Identity(4), frame)
    return out


def refused(operator, message, **arguments):
    try:
        operator(**arguments)
    except RuntimeError as error:
        assert message in str(error), error
        return
    raise AssertionError(f"not refused: {message}")


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.preferences.addon_install(filepath=str(ADDON))
    bpy.ops.preferences.addon_enable(module="retarget_addon")
    import retarget_addon

    scene = bpy.context.scene
    scene.render.fps = 30
    a, b = armature("a", (0.4, -1, 0)), armature("b", (2, 3, 0))
    scene.frame_start, scene.frame_end = FIRST, FIRST + FRAMES - 1
    settings = scene.retarget
    originals = [a.animation_data.action, b.animation_data.action]
    before = [snapshot(action) for action in originals]

    # What is wrong is said as the program says it, and changes nothing.
    refused(bpy.ops.retarget.solve, "choose a", wait=True)
    settings.template_file = str(HOLD / "template.yaml")
    refused(bpy.ops.retarget.solve, "figure a: choose an armature", wait=True)
    settings.figure_a, settings.figure_b = a, b
    settings.template_frame = 1000
    refused(bpy.ops.retarget.solve, "frame 1000", wait=True)
    settings.template_frame = FIRST
    settings.template_file = "/nowhere.yaml"
    refused(bpy.ops.retarget.solve, "/nowhere.yaml", wait=True)
    settings.template_file = str(HOLD / "template.yaml")
    assert [t.animation_data.action for t in (a, b)] == originals

    actions = len(bpy.data.actions)
    assert bpy.ops.retarget.solve(wait=True) == {"FINISHED"}
    out = pathlib.Path(settings.report).parent
    assert (out / "report.html").exists() and settings.status, settings.status

    # New actions above the originals, which are as they were.
    assert len(bpy.data.actions) == actions + 2
    assert [snapshot(action) for action in originals] == before
    for thing, original in zip((a, b), originals):
        tracks = thing.animation_data.nla_tracks
        assert [t.name for t in tracks][-1] == "Retarget"
        assert [s.action for s in tracks[-2].strips] == [original]
        new = tracks[-1].strips[0].action
        assert new not in originals and new.pose_markers, "no markers"
        assert any("tag 1" in m.name for m in new.pose_markers)

    # Joints against the files: the solved clip on this very rig, and the scene.
    from retarget_addon import clips

    nodes = glb_positions(out / "scene.glb")
    rigs = {f: clips.poses_of_bvh((out / f"{f}.bvh").read_text()) for f in "ab"}
    report = json.loads((out / "report.json").read_text())
    worst = {"glb": 0.0, "bvh": 0.0, "checked": 0,
             "write_back": max(report["write_back"][f]["largest_error_m"] for f in "ab")}
    for k in range(FRAMES):
        scene.frame_set(FIRST + k)
        for label, thing in (("a", a), ("b", b)):
            found = heads(thing)
            for bone, node in NODES.items():
                if bone not in found:
                    continue
                error = (found[bone] - nodes[f"{label}/{node}"][k]).length
                worst["glb"] = max(worst["glb"], error)
                rig = rigs[label][k][bone][1]
                error = (found[bone] - Vector((rig.x, -rig.z, rig.y))).length
                worst["bvh"] = max(worst["bvh"], error)
                worst["checked"] += 1
    # Muting the track brings the capture back.
    scene.frame_set(FIRST + 5)
    solved = heads(a)["Hips"].copy()
    a.animation_data.nla_tracks[-1].mute = True
    scene.frame_set(FIRST + 5)
    captured = heads(a)["Hips"].copy()
    a.animation_data.nla_tracks[-1].mute = False
    worst["moved"] = (solved - captured).length

    # A template from the solved posture, and what it is called.
    scene.frame_set(FIRST + 3)
    path = WORK / "mine.yaml"
    assert bpy.ops.retarget.make_template(filepath=str(path)) == {"FINISHED"}
    text = path.read_text()
    assert "name: mine" in text and settings.template_file == str(path)

    # Cancelling ends the process.
    from retarget_addon import program

    job = program.Job([program.find(), "--clip-a", str(HOLD / "a.bvh"), "--clip-b",
                       str(HOLD / "b.bvh"), "--template", str(HOLD / "template.yaml"), "--out",
                       str(WORK / "cancelled"), "--progress", "json"])
    assert job.poll() is None
    job.cancel()
    assert job.poll() is not None and not (WORK / "cancelled" / "report.json").exists()
    assert program.templates(program.libraries(program.find(), str(SOURCE / "data" / "holds")))

    # Undo takes the layer away and leaves the capture.
    worst["undo"] = undo(settings, a.name, originals[0].name)
    (WORK / "result.json").write_text(json.dumps(worst))
    bpy.ops.preferences.addon_disable(module="retarget_addon")


def undo(settings, name, original):
    """Whether the step before the solve comes back, where Blender keeps steps without a window."""
    settings.template_file = str(HOLD / "template.yaml")
    bpy.context.scene.frame_end = FIRST + 9
    bpy.ops.ed.undo_push(message="before")
    count = len(bpy.data.actions)
    tracks = len(bpy.data.objects[name].animation_data.nla_tracks)
    assert bpy.ops.retarget.solve(wait=True) == {"FINISHED"}
    bpy.ops.ed.undo_push(message="Solve")
    assert len(bpy.data.objects[name].animation_data.nla_tracks) > tracks
    bpy.ops.ed.undo()
    thing = bpy.data.objects[name]
    assert len(thing.animation_data.nla_tracks) == tracks
    assert len(bpy.data.actions) == count
    assert original in bpy.data.actions
    return True


main()
