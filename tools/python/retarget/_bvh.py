"""A clip out of arrays, by way of BVH."""

import numpy as np

from ._retarget import Clip, InputError


def _zxy_degrees(rotations):
    """Euler angles of quaternions [..., 4] (x, y, z, w): R = Rz Rx Ry, [..., 3] in degrees."""
    x, y, z, w = np.moveaxis(rotations / np.linalg.norm(rotations, axis=-1, keepdims=True), -1, 0)
    sin_x = np.clip(2 * (y * z + x * w), -1, 1)
    locked = np.abs(sin_x) > 1 - 1e-12
    about_z = np.where(
        locked,
        np.arctan2(2 * (x * y + z * w), 1 - 2 * (y * y + z * z)),
        np.arctan2(-2 * (x * y - z * w), 1 - 2 * (x * x + z * z)),
    )
    about_y = np.where(
        locked, 0, np.arctan2(-2 * (x * z - y * w), 1 - 2 * (x * x + y * y))
    )
    angles = np.stack([about_z, np.arcsin(sin_x), about_y], axis=-1)
    # No jumps of a whole turn from frame to frame.
    return np.degrees(np.unwrap(angles, axis=0))


def _number(value):
    return f"{value:.9g}"


def _vector(values):
    return " ".join(_number(v) for v in values)


def clip_from_arrays(
    names, parents, offsets, rotations, root, fps, *, end_sites=None, units="m", name="arrays", **options
):
    """A clip of one figure.

    names: [J] of the joints, parents before their children; parents: [J] indices, -1 for the one
    root; offsets: [J, 3], of each joint in its parent at rest; rotations: [T, J, 4], local unit
    quaternions [x, y, z, w]; root: [T, 3], position of the root; fps: frames per second.
    end_sites: {joint name: [3]}, where a leaf ends, in its own frame. units: of all lengths.
    Other options are those of Clip.
    """
    offsets = np.asarray(offsets, dtype=float)
    rotations = np.asarray(rotations, dtype=float)
    root = np.asarray(root, dtype=float)
    parents = [int(p) for p in parents]
    count = len(names)
    frames = rotations.shape[0]
    if offsets.shape != (count, 3):
        raise InputError(f"offsets: expected [{count}, 3], found {list(offsets.shape)}")
    if rotations.shape != (frames, count, 4):
        raise InputError(f"rotations: expected [T, {count}, 4], found {list(rotations.shape)}")
    if root.shape != (frames, 3):
        raise InputError(f"root: expected [{frames}, 3], found {list(root.shape)}")
    if len(parents) != count or parents.count(-1) != 1 or parents[0] != -1:
        raise InputError(f"parents: expected {count} of them, -1 for the first joint alone")
    if any(not -1 <= p < j for j, p in enumerate(parents)):
        raise InputError("parents: expected each before its children")
    for label, values in (("offsets", offsets), ("rotations", rotations), ("root", root)):
        if not np.isfinite(values).all():
            raise InputError(f"{label}: found a number that is not finite")
    for joint in names:
        if not joint or any(c.isspace() for c in joint):
            raise InputError(f"names: found {joint!r}, expected a name without blanks")

    lines, order = ["HIERARCHY"], []
    ends = dict(end_sites or {})
    for joint in ends:
        if joint not in names:
            raise InputError(f"end_sites: found {joint!r}, expected one of the names")

    def write(joint, depth):
        order.append(joint)
        pad = "  " * depth
        kind = "ROOT" if parents[joint] < 0 else "JOINT"
        channels = "CHANNELS 3 Zrotation Xrotation Yrotation"
        if parents[joint] < 0:
            channels = "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation"
        lines.extend(
            [
                f"{pad}{kind} {names[joint]}",
                f"{pad}{{",
                f"{pad}  OFFSET {_vector(offsets[joint])}",
                f"{pad}  {channels}",
            ]
        )
        children = [k for k in range(count) if parents[k] == joint]
        for child in children:
            write(child, depth + 1)
        if not children:
            end = ends.get(names[joint], np.zeros(3))
            lines.extend(
                [f"{pad}  End Site", f"{pad}  {{", f"{pad}    OFFSET {_vector(end)}", f"{pad}  }}"]
            )
        lines.append(f"{pad}}}")

    write(0, 0)
    angles = _zxy_degrees(rotations)[:, order]
    lines.extend(["MOTION", f"Frames: {frames}", f"Frame Time: {1 / fps:.12g}"])
    table = np.concatenate([root, angles.reshape(frames, -1)], axis=1)
    lines.extend(_vector(row) for row in table)
    text = "\n".join(lines) + "\n"
    return Clip(text.encode(), name=name, units=units, **options)
