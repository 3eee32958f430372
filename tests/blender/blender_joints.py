"""Where Blender puts the joints of an animated file, frame by frame: an independent reader.

    blender --background --factory-startup --python-exit-code 1 \\
        --python blender_joints.py -- FILE OUT.json --fps N [--animation NAME]

FILE is .glb, .gltf or .bvh. Bones and other objects that are no meshes count as joints. OUT.json:
{"fps": N, "joints": {name: [[x, y, z] per frame]}}, world positions in the file's own unit and
in the axes of glTF (Y up). Frames are those from the first key to the last, at N per second.
"""
import argparse
import builtins
import json
import pathlib
import sys

import bpy
import numpy

# Blender 3.4's importers use two spellings that later Python and NumPy dropped.
if "bool" not in vars(numpy):
    numpy.bool = bool
_open = builtins.open
builtins.open = lambda file, mode="r", *rest, **named: _open(
    file, mode.replace("U", ""), *rest, **named
)


def import_file(path, fps):
    """Imports into an empty scene whose frames are 1/fps s, so that keys fall on frames."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    render = bpy.context.scene.render
    render.fps = max(1, round(fps))
    render.fps_base = render.fps / fps
    if path.suffix.lower() == ".bvh":
        bpy.ops.import_anim.bvh(
            filepath=str(path), axis_forward="-Z", axis_up="Y", use_fps_scale=False
        )
    else:
        bpy.ops.import_scene.gltf(filepath=str(path))


def to_gltf(v):
    """Blender's (x, y, z) is glTF's (x, -z, y)."""
    return [v.x, v.z, -v.y]


def joints():
    """World positions of all joints in the scene's present frame, by name."""
    found = {}
    for thing in bpy.context.scene.objects:
        if thing.type == "ARMATURE":
            for bone in thing.pose.bones:
                found[bone.name] = to_gltf(thing.matrix_world @ bone.head)
        elif thing.type == "EMPTY":
            found[thing.name] = to_gltf(thing.matrix_world.translation)
    return found


def play(animation):
    """Of several animations, which the importer lays into NLA tracks, plays one."""
    actions = []
    for thing in bpy.context.scene.objects:
        data = thing.animation_data
        for track in data.nla_tracks if data else []:
            track.mute = True
            if track.name == animation:
                data.action = track.strips[0].action
                actions.append(data.action)
    if not actions:
        raise SystemExit(f"no animation {animation!r}")
    return actions


def main():
    parser = argparse.ArgumentParser(prog="blender_joints.py")
    parser.add_argument("file", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--fps", type=float, required=True)
    parser.add_argument("--animation", help="of a glTF file with several")
    options = parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])
    import_file(options.file, options.fps)
    actions = play(options.animation) if options.animation else bpy.data.actions
    ranges = [action.frame_range for action in actions]
    first = round(min((r[0] for r in ranges), default=0))
    last = round(max((r[1] for r in ranges), default=0))
    curves = {}
    for frame in range(first, last + 1):
        bpy.context.scene.frame_set(frame)
        for name, position in joints().items():
            curves.setdefault(name, []).append(position)
    options.out.write_text(json.dumps({"fps": options.fps, "joints": curves}))


main()
