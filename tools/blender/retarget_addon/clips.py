"""Armatures as BVH clips, and solved BVH clips as actions.

A bone's joint in the BVH has the axes of the world at rest, so that its rotation is that of the
bone against its rest pose; all lengths are metres, Y up. The way back is the exact inverse.
"""

import math

import bpy
from mathutils import Euler, Matrix, Quaternion, Vector

# Blender's (x, y, z) is the file's (x, z, -y).
TO_FILE = Matrix(((1, 0, 0), (0, 0, 1), (0, -1, 0)))
FROM_FILE = TO_FILE.transposed()

# A bone whose head moves further than this against its parent has position channels.
MOVES = 1e-5  # m


class Skeleton:
    """The bones of an armature that are written, parents first."""

    def __init__(self, armature):
        self.armature = armature
        bones = armature.data.bones
        keep = {bone.name for bone in bones if bone.use_deform}
        keep = keep or {bone.name for bone in bones}
        for bone in bones:  # what carries them, too
            if bone.name in keep:
                keep.update(parent.name for parent in bone.parent_recursive)
        self.names, self.parents = [], []

        def add(bone, parent):
            if bone.name in keep:
                parent_of_children = len(self.names)
                self.names.append(bone.name)
                self.parents.append(parent)
            else:
                parent_of_children = parent
            for child in bone.children:
                add(child, parent_of_children)

        roots = [bone for bone in bones if bone.parent is None and bone.name in keep]
        for bone in roots:
            add(bone, -1)
        self.single_root = len(roots) == 1
        self.rest = [bones[name].matrix_local.copy() for name in self.names]
        self.tails = [bones[name].tail_local.copy() for name in self.names]
        # Blanks end a name in BVH.
        self.joints = [name.replace(" ", "_") for name in self.names]
        if len(set(self.joints)) < len(self.joints):
            raise ValueError(f"{armature.name}: two bones differ by a blank in their names alone")
        for name, joint in zip(self.names, self.joints):
            if any(c.isspace() or c in "{}" for c in joint):
                raise ValueError(f"{armature.name}: the bone {name!r} has blanks or braces")

    def scale(self):
        """Metres per unit of the armature's space, the same along all axes."""
        sizes = self.armature.matrix_world.to_scale()
        if max(sizes) - min(sizes) > 1e-4 * max(sizes):
            raise ValueError(f"{self.armature.name}: its scale is uneven; apply it first")
        return sizes[0]


def _world(armature):
    """Rotation and origin of the armature's space in the file's, and the scale."""
    matrix = armature.matrix_world
    return TO_FILE @ matrix.to_quaternion().to_matrix(), TO_FILE @ matrix.translation


def _angles(rotation, before):
    """Degrees about z, x, y: R = Rz Rx Ry. Near those of the frame before."""
    # An Euler of order YXZ turns about y first, then x, then z.
    euler = rotation.to_euler("YXZ", Euler(before, "YXZ")) if before else rotation.to_euler("YXZ")
    return euler


def sample(skeleton, frames, scene):
    """Global rotations and heads of all bones in the file's space: [frame][bone]."""
    armature = skeleton.armature
    current = scene.frame_current
    poses = []
    scale = skeleton.scale()
    rest = [matrix.to_quaternion().to_matrix() for matrix in skeleton.rest]
    for frame in frames:
        scene.frame_set(frame)
        turn, origin = _world(armature)
        pose = []
        for k, name in enumerate(skeleton.names):
            matrix = armature.pose.bones[name].matrix
            rotation = matrix.to_quaternion().to_matrix() @ rest[k].transposed()
            # The bone against its rest, in the axes of the file.
            pose.append((turn @ rotation @ TO_FILE.transposed(),
                         origin + scale * (turn @ matrix.translation)))
        poses.append(pose)
    scene.frame_set(current)
    return poses


def write_bvh(skeleton, frames, scene, fps):
    """The armature's motion in these frames of the scene, as the text of a BVH file."""
    poses = sample(skeleton, frames, scene)
    scale = skeleton.scale()
    heads = [scale * (TO_FILE @ matrix.translation) for matrix in skeleton.rest]
    tails = [scale * (TO_FILE @ tail) for tail in skeleton.tails]
    count = len(skeleton.names)

    def parent_pose(pose, k):
        parent = skeleton.parents[k]
        return pose[parent] if parent >= 0 else (Matrix.Identity(3), Vector((0, 0, 0)))

    local = []  # [frame][bone] rotation, position in the parent
    for pose in poses:
        line = []
        for k in range(count):
            turn, origin = parent_pose(pose, k)
            line.append((turn.transposed() @ pose[k][0],
                         turn.transposed() @ (pose[k][1] - origin)))
        local.append(line)
    offsets = [heads[k] - (heads[p] if p >= 0 else Vector((0, 0, 0)))
               for k, p in enumerate(skeleton.parents)]
    moves = [p < 0 or any((line[k][1] - offsets[k]).length > MOVES for line in local)
             for k, p in enumerate(skeleton.parents)]

    text, order = ["HIERARCHY"], []

    def numbers(values):
        return " ".join(f"{v:.9g}" for v in values)

    def joint(k, depth):
        order.append(k)
        pad = "  " * depth
        text.append(f"{pad}{'JOINT' if depth else 'ROOT'} {skeleton.joints[k]}")
        text.append(pad + "{")
        text.append(f"{pad}  OFFSET {numbers(offsets[k])}")
        position = "Xposition Yposition Zposition " if moves[k] else ""
        text.append(f"{pad}  CHANNELS {6 if moves[k] else 3} {position}"
                    "Zrotation Xrotation Yrotation")
        children = [c for c in range(count) if skeleton.parents[c] == k]
        for child in children:
            joint(child, depth + 1)
        if not children:
            text.append(pad + "  End Site")
            text.append(pad + "  {")
            text.append(f"{pad}    OFFSET {numbers(tails[k] - heads[k])}")
            text.append(pad + "  }")
        text.append(pad + "}")

    if not skeleton.single_root:
        raise ValueError(f"{skeleton.armature.name}: has several root bones; give them one parent")
    joint(0, 0)
    text.append("MOTION")
    text.append(f"Frames: {len(frames)}")
    text.append(f"Frame Time: {1 / fps:.12g}")
    before = [None] * count
    for line in local:
        values = []
        for k in order:
            rotation, position = line[k]
            before[k] = _angles(rotation, before[k])
            if moves[k]:
                values.extend(position)
            values.extend(math.degrees(a) for a in (before[k].z, before[k].x, before[k].y))
        text.append(numbers(values))
    return "\n".join(text) + "\n"


def read_bvh(text):
    """Names, parents, offsets, channels and numbers of a BVH file of this add-on or the program."""
    words = iter(text.split())
    names, parents, offsets, channels, stack = [], [], [], [], []
    in_end = False
    for word in words:
        if word in ("ROOT", "JOINT"):
            names.append(next(words))
            parents.append(stack[-1] if stack else -1)
            channels.append([])
        elif word == "End":
            in_end = True
        elif word == "{":
            stack.append(len(names) - 1)
        elif word == "}":
            stack.pop()
            in_end = False
        elif word == "OFFSET":
            offset = Vector([float(next(words)) for _ in range(3)])
            if not in_end:
                offsets.append(offset)
        elif word == "CHANNELS":
            channels[-1] = [next(words) for _ in range(int(next(words)))]
        elif word == "MOTION":
            break
    next(words)  # Frames:
    frames = int(next(words))
    for _ in range(2):
        next(words)  # Frame Time:
    frame_time = float(next(words))
    numbers = [float(word) for word in words]
    return names, parents, offsets, channels, frames, frame_time, numbers


def poses_of_bvh(text):
    """{joint: (rotation, position)} in the world of the file, for each frame."""
    names, parents, offsets, channels, frames, _, numbers = read_bvh(text)
    width = sum(len(c) for c in channels)
    if len(numbers) != frames * width:
        raise ValueError("the solved clip is cut short")
    axes = {"X": Vector((1, 0, 0)), "Y": Vector((0, 1, 0)), "Z": Vector((0, 0, 1))}
    poses = []
    for frame in range(frames):
        at, world = frame * width, []
        for k, joint in enumerate(names):
            turn, position = Quaternion(), offsets[k].copy()
            for channel in channels[k]:
                value = numbers[at]
                at += 1
                if channel.endswith("position"):
                    position["XYZ".index(channel[0])] = value
                else:
                    turn = turn @ Quaternion(axes[channel[0]], math.radians(value))
            if parents[k] >= 0:
                parent_turn, parent_position = world[parents[k]]
                position = parent_position + parent_turn @ position
                turn = parent_turn @ turn
            world.append((turn, position))
        poses.append({joint: world[k] for k, joint in enumerate(names)})
    return poses


def make_action(skeleton, text, first_frame, name, scene):
    """A new action of the armature out of a solved BVH clip. Nothing else is changed."""
    armature = skeleton.armature
    poses = poses_of_bvh(text)
    scale = skeleton.scale()
    turn, origin = _world(armature)
    rest = [matrix.to_quaternion().to_matrix() for matrix in skeleton.rest]
    action = bpy.data.actions.new(name)
    action.use_fake_user = True
    bones = armature.data.bones
    index = {name: k for k, name in enumerate(skeleton.names)}
    curves = {name: [] for name in skeleton.names}  # of (location, quaternion) per frame
    for pose in poses:
        placed = {}
        for k, bone_name in enumerate(skeleton.names):
            rotation, position = pose[skeleton.joints[k]]
            local = turn.transposed() @ rotation.to_matrix() @ TO_FILE @ rest[k]
            matrix = local.to_4x4()
            matrix.translation = turn.transposed() @ (position - origin) / scale
            placed[bone_name] = matrix
            bone = bones[bone_name]
            # The nearest parent that is written; those between stay at rest.
            between = bone.matrix_local.copy()
            ancestor = bone.parent
            while ancestor is not None and ancestor.name not in index:
                ancestor = ancestor.parent
            if ancestor is not None:
                between = ancestor.matrix_local.inverted() @ between
                matrix = placed[ancestor.name].inverted() @ matrix
            basis = between.inverted() @ matrix
            curves[bone_name].append((basis.to_translation(), basis.to_quaternion()))

    def add(path, group, columns):
        for k, values in enumerate(columns):
            curve = action.fcurves.new(path, index=k, action_group=group)
            curve.keyframe_points.add(len(values))
            points = [x for t, v in enumerate(values) for x in (first_frame + t, v)]
            curve.keyframe_points.foreach_set("co", points)
            for point in curve.keyframe_points:
                point.interpolation = "LINEAR"
            curve.update()

    for bone_name, keys in curves.items():
        pose_bone = armature.pose.bones[bone_name]
        path = f'pose.bones["{bpy.utils.escape_identifier(bone_name)}"].'
        for before, after in zip(keys, keys[1:]):
            if before[1].dot(after[1]) < 0:
                after[1].negate()
        if pose_bone.rotation_mode == "QUATERNION":
            add(path + "rotation_quaternion", bone_name, zip(*(q for _, q in keys)))
        elif pose_bone.rotation_mode == "AXIS_ANGLE":
            turns = [(q.to_axis_angle()) for _, q in keys]
            add(path + "rotation_axis_angle", bone_name, zip(*((a, *v) for v, a in turns)))
        else:
            eulers, before = [], None
            for _, q in keys:
                order = pose_bone.rotation_mode
                before = q.to_euler(order, before) if before else q.to_euler(order)
                eulers.append(before)
            add(path + "rotation_euler", bone_name, zip(*eulers))
        if not bones[bone_name].use_connect:
            add(path + "location", bone_name, zip(*(v for v, _ in keys)))
    return action
