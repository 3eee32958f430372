#!/usr/bin/env python3
"""What a written scene shows, worked out from its GLB files alone: a second opinion on the program's own metrics.

    tools/bench/common_bars.py OUT [OUT ...]

Reads scene.glb, source.glb, baseline.glb and, from report.json, what cannot be seen in them: radii, segment
lengths, tags, holds, planted feet, exit code. Lengths in m. Shares no code with the program: GLI by solid angles
(Klenin and Langowski 2000), distances of segments by their four end points and the two lines. Needs numpy.
"""
import json
import pathlib
import struct
import sys

import numpy as np

BETWEEN = 4  # instants per frame
BARS = {"gli": 0.5, "penetration": 0.02, "deep_percent": 1, "floor": 0.01, "drift": 0.01, "slide_percent": 2, "hold": 0.02,
        "length_percent": 0.5, "pose_cm": 12}


# -- GLB -----------------------------------------------------------------------------------------


def turned(q, v):
    """v turned by the quaternions q, x y z w in the last axis."""
    u, w = q[..., :3], q[..., 3:]
    t = 2 * np.cross(u, v)
    return v + w * t + np.cross(u, t)


def product(p, q):
    x = p[..., 3:] * q[..., :3] + q[..., 3:] * p[..., :3] + np.cross(p[..., :3], q[..., :3])
    w = p[..., 3:] * q[..., 3:] - np.sum(p[..., :3] * q[..., :3], axis=-1, keepdims=True)
    return np.concatenate([x, w], axis=-1)


def slerp(p, q, u):
    """Between quaternions p and q [n x 4] at u [n]."""
    c = np.sum(p * q, axis=-1)
    q = np.where(c[:, None] < 0, -q, q)
    angle = np.arccos(np.clip(np.abs(c), 0, 1))
    s = np.sin(angle)
    near = s < 1e-9
    s = np.where(near, 1, s)
    a = np.where(near, 1 - u, np.sin((1 - u) * angle) / s)
    b = np.where(near, u, np.sin(u * angle) / s)
    out = a[:, None] * p + b[:, None] * q
    return out / np.linalg.norm(out, axis=-1, keepdims=True)


class Scene:
    """place(node) [instants x 3] and turn(node) [instants x 4] of the nodes by name; instant BETWEEN * t is frame t."""

    def __init__(self, path):
        data = pathlib.Path(path).read_bytes()
        size = struct.unpack("<I", data[12:16])[0]
        j = json.loads(data[20:20 + size])
        binary = data[20 + size + 8:]
        self.nodes = j["nodes"]
        self.index = {n["name"]: i for i, n in enumerate(self.nodes) if "name" in n}
        self.parent = {c: i for i, n in enumerate(self.nodes) for c in n.get("children", [])}

        def read(i):
            a = j["accessors"][i]
            view = j["bufferViews"][a["bufferView"]]
            width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[a["type"]]
            start = view.get("byteOffset", 0) + a.get("byteOffset", 0)
            return np.frombuffer(binary, "<f4", a["count"] * width, start).reshape(-1, width).astype(float)

        self.track, animation = {}, j["animations"][0]
        for channel in animation["channels"]:
            sampler = animation["samplers"][channel["sampler"]]
            self.track[channel["target"]["node"], channel["target"]["path"]] = read(sampler["output"])
            self.times = read(sampler["input"])[:, 0]
        self.frames = len(self.times)
        instants = np.arange(BETWEEN * (self.frames - 1) + 1)
        self.k = np.minimum(instants // BETWEEN, max(self.frames - 2, 0))
        self.u = instants / BETWEEN - self.k
        self.world = {}

    def local(self, i):
        n = self.nodes[i]
        shape = (len(self.k), 1)
        place = np.tile(np.array(n.get("translation", [0, 0, 0]), float), shape)
        turn = np.tile(np.array(n.get("rotation", [0, 0, 0, 1]), float), shape)
        if (i, "translation") in self.track:
            v = self.track[i, "translation"]
            place = (1 - self.u)[:, None] * v[self.k] + self.u[:, None] * v[np.minimum(self.k + 1, self.frames - 1)]
        if (i, "rotation") in self.track:
            v = self.track[i, "rotation"]
            turn = slerp(v[self.k], v[np.minimum(self.k + 1, self.frames - 1)], self.u)
        return place, turn

    def of(self, i):
        if i not in self.world:
            place, turn = self.local(i)
            if i in self.parent:
                p, q = self.of(self.parent[i])
                place, turn = p + turned(q, place), product(q, turn)
            self.world[i] = place, turn
        return self.world[i]

    def place(self, name):
        return self.of(self.index[name])[0]

    def carrier_turn(self, name):
        """Of the link that carries the node: a node's own rotation is that of the joint in it."""
        i = self.index[name]
        return self.of(self.parent[i] if not name.endswith("/root") else i)[1]


# -- Geometry ------------------------------------------------------------------------------------


def unit(v):
    n = np.linalg.norm(v, axis=-1, keepdims=True)
    return v / np.where(n < 1e-14, 1, n)


def gli(a, b, c, d):
    """Of segments a-b and c-d, arrays of points; Klenin and Langowski 2000, method 1a, signed as Ho and Komura's Eq. 1."""
    r13, r14, r23, r24 = c - a, d - a, c - b, d - b
    n = [unit(np.cross(x, y)) for x, y in ((r13, r14), (r14, r24), (r24, r23), (r23, r13))]
    total = sum(np.arcsin(np.clip(np.sum(n[k] * n[(k + 1) % 4], axis=-1), -1, 1)) for k in range(4))
    sign = np.sign(np.sum(np.cross(d - c, b - a) * r13, axis=-1))
    return sign * total / (4 * np.pi)


def segment_distance(a, b, c, d):
    """Least of end point to segment (four ways) and of the inner points of the two lines."""

    def to_segment(p, s, e):
        v = e - s
        u = np.clip(np.sum((p - s) * v, -1) / np.maximum(np.sum(v * v, -1), 1e-18), 0, 1)
        return np.linalg.norm(p - s - u[..., None] * v, axis=-1)

    least = np.minimum(np.minimum(to_segment(a, c, d), to_segment(b, c, d)), np.minimum(to_segment(c, a, b), to_segment(d, a, b)))
    u, v, w = b - a, d - c, a - c
    uu, uv, vv, uw, vw = (np.sum(x * y, -1) for x, y in ((u, u), (u, v), (v, v), (u, w), (v, w)))
    det = uu * vv - uv * uv
    safe = np.where(det < 1e-14, 1, det)
    s, t = (uv * vw - vv * uw) / safe, (uu * vw - uv * uw) / safe
    inner = (det >= 1e-14) & (s >= 0) & (s <= 1) & (t >= 0) & (t <= 1)
    across = np.linalg.norm(w + s[..., None] * u - t[..., None] * v, axis=-1)
    return np.where(inner, np.minimum(least, across), least)


class Figure:
    def __init__(self, report, f):
        body = report["bodies"][f]
        self.f = f
        self.names = [n["name"] for n in body["nodes"]]
        self.parent = {n["name"]: n["parent"] for n in body["nodes"]}
        self.radius, self.length = body["radius"], body["length"]
        self.outer = [n for n in self.names if self.parent[n]]  # segments by their outer node
        self.stands = bool(report["supports"][f])
        self.contacts = report["contacts"][f]

    def widest(self, node):
        return max([self.radius.get(node, 0)] + [self.radius[n] for n in self.outer if self.parent[n] == node])

    def route(self, start, end):
        """Nodes from start to end along the tree."""

        def up(n):
            way = [n]
            while self.parent[way[-1]]:
                way.append(self.parent[way[-1]])
            return way

        a, b = up(start), up(end)
        shared = next(n for n in a if n in b)
        return a[:a.index(shared) + 1] + b[:b.index(shared)][::-1]

    def points(self, scene):
        return {n: scene.place(f"{self.f}/{n}") for n in self.names}


# -- Measures ------------------------------------------------------------------------------------


def tag_values(report, figures, points):
    """s GLI of every tag [instants]."""
    out = []
    for tag in report["tangles"]:
        routes = [figures[k].route(*tag[f]) for k, f in enumerate("ab")]
        total = 0
        for i in range(len(routes[0]) - 1):
            for k in range(len(routes[1]) - 1):
                total = total + gli(points[0][routes[0][i]], points[0][routes[0][i + 1]], points[1][routes[1][k]], points[1][routes[1][k + 1]])
        out.append(np.sign(tag["template_gli"]) * total)
    return out


def neighbours(figure):
    """Pairs of segments that follow each other on a path, with the sign of the first when it is walked so."""
    pairs = []
    for i, m in enumerate(figure.outer):
        for k, n in enumerate(figure.outer):
            if figure.parent[n] == m:
                pairs.append((i, k, 1))
            elif i < k and figure.parent[n] == figure.parent[m]:
                pairs.append((i, k, -1))
    return pairs


def pass_throughs(figures, points):
    """Instants at which the GLI of two segments, or of a segment and two that follow each other, leaps by over a half."""
    a = [[points[0][figures[0].parent[n]], points[0][n]] for n in figures[0].outer]
    b = [[points[1][figures[1].parent[n]], points[1][n]] for n in figures[1].outer]
    table = np.zeros((len(a), len(b), len(a[0][0])))
    for i, (p, q) in enumerate(a):
        for k, (r, s) in enumerate(b):
            # Far apart, a segment pair cannot have passed through another between two instants.
            near = np.linalg.norm(p + q - r - s, axis=-1) / 2 < 1.5
            table[i, k, near] = gli(p[near], q[near], r[near], s[near])
    leaps = np.abs(np.diff(table)).max(axis=(0, 1))
    for i, k, sign in neighbours(figures[0]):
        leaps = np.maximum(leaps, np.abs(np.diff(table[k] + sign * table[i])).max(axis=0))
    for i, k, sign in neighbours(figures[1]):
        leaps = np.maximum(leaps, np.abs(np.diff(table[:, k] + sign * table[:, i])).max(axis=0))
    return int(np.sum(leaps > 0.5))


def depth_between(figures, points):
    """Deepest overlap of the bodies [instants]."""
    deepest = np.full(len(points[0]["root"]), -1.0)
    for m in figures[0].outer:
        for n in figures[1].outer:
            p, q, r, s = points[0][figures[0].parent[m]], points[0][m], points[1][figures[1].parent[n]], points[1][n]
            deepest = np.maximum(deepest, figures[0].radius[m] + figures[1].radius[n] - segment_distance(p, q, r, s))
    return deepest


def depth_within(figure, points):
    deepest = 0.0
    on_frames = {n: p[::BETWEEN] for n, p in points.items()}
    for i, m in enumerate(figure.outer):
        for n in figure.outer[i + 1:]:
            ends = [{figure.parent[x], x} for x in (m, n)]
            joined = any({figure.parent[x], x} & ends[0] and {figure.parent[x], x} & ends[1] for x in figure.outer)
            if ends[0] & ends[1] or joined:
                continue
            d = segment_distance(on_frames[figure.parent[m]], on_frames[m], on_frames[figure.parent[n]], on_frames[n])
            deepest = max(deepest, float(np.max(figure.radius[m] + figure.radius[n] - d)))
    return deepest


def jerk(figure, points, fps):
    return float(np.mean([np.linalg.norm(np.diff(points[n][::BETWEEN], 3, axis=0), axis=-1).mean() for n in figure.names]) * fps**3)


def pose_error_cm(figure, points, source, nodes):
    p = np.stack([points[n][::BETWEEN] - points["root"][::BETWEEN] for n in figure.names], 1)
    q = np.stack([source[n][::BETWEEN] - source["root"][::BETWEEN] for n in figure.names], 1)
    c = np.sum(q[..., 0] * p[..., 0] + q[..., 2] * p[..., 2], 1)
    s = np.sum(q[..., 2] * p[..., 0] - q[..., 0] * p[..., 2], 1)
    yaw = np.arctan2(s, c)[:, None]
    x, z = q[..., 0] * np.cos(yaw) + q[..., 2] * np.sin(yaw), q[..., 2] * np.cos(yaw) - q[..., 0] * np.sin(yaw)
    away = np.linalg.norm(p - np.stack([x, q[..., 1], z], -1), axis=-1)
    return 100 * float(np.mean([away[:, figure.names.index(n)].mean() for n in nodes]))


def travel(points, node):
    return float(np.linalg.norm(np.diff(points[node][::BETWEEN] - points["root"][::BETWEEN], axis=0), axis=-1).sum())


def feet(figure, points, fps):
    """Largest drift (m) and share of stance frames over 1 cm/s (%)."""
    drift, stance, sliding = 0.0, 0, 0
    for c in figure.contacts:
        p = points[c["node"]][::BETWEEN][c["first"]:c["last"] + 1]
        drift = max(drift, float(np.linalg.norm((p - p[0])[:, [0, 2]], axis=-1).max()))
        speed = fps * np.linalg.norm(np.diff(p, axis=0), axis=-1)
        stance, sliding = stance + len(speed), sliding + int(np.sum(speed > 0.01))
    return drift, 100 * sliding / stance if stance else 0.0


def hold_errors(report, scene):
    def held(point):
        if point["figure"] == "world":
            return np.array(point["position"], float)
        name = f"{point['figure']}/{point['node']}"
        return scene.place(name) + turned(scene.carrier_turn(name), np.array(point["offset"], float))

    return [float(np.linalg.norm(held(h["from"]) - held(h["to"]), axis=-1).max()) for h in report["holds"]]


def coarse(report, figures, scene):
    """Tags lost (frames), pass-throughs and deepest overlap: what a result is compared with its baseline in."""
    points = [f.points(scene) for f in figures]
    tags = tag_values(report, figures, points)
    lost = int(np.sum(np.any([t[::BETWEEN] <= 0.5 for t in tags], axis=0))) if tags else 0
    depth = depth_between(figures, points)
    return {"tags": tags, "lost": lost, "through": pass_throughs(figures, points), "depth": depth, "points": points}


def evaluate(folder):
    """Figures of a run, what it misses of the common bars, and where it is worse than its baseline."""
    folder = pathlib.Path(folder)
    report = json.loads((folder / "report.json").read_text())
    fps = report["fps"]
    figures = [Figure(report, f) for f in "ab"]
    result = coarse(report, figures, Scene(folder / "scene.glb"))
    baseline = coarse(report, figures, Scene(folder / "baseline.glb"))
    source_scene = Scene(folder / "source.glb")
    source = [f.points(source_scene) for f in figures]
    out = {"exit": report["exit_code"], "frames": report["frames"]}
    missed = []

    def judge(name, value, limit, least=False):
        out[name] = value
        if value < limit if least else value > limit:
            missed.append(f"{name} {value:.3g}")

    judge("gli", min((float(t.min()) for t in result["tags"]), default=1.0), BARS["gli"] + 1e-9, least=True)
    judge("pass-throughs", result["through"], 0)
    judge("penetration", float(result["depth"].max()), BARS["penetration"])
    judge("deep_percent", 100 * float(np.mean(result["depth"][::BETWEEN] > 0.01)), BARS["deep_percent"])
    judge("hold", max(hold_errors(report, Scene(folder / "scene.glb")), default=0.0), BARS["hold"])
    jerks = [jerk(f, p, fps) for f, p in zip(figures, source)]
    for k, f in enumerate(figures):
        p, q, who = result["points"][k], source[k], f" {f.f}"
        within, before = depth_within(f, p), depth_within(f, q)
        judge("self" + who, within, max(0.02, before + 0.001))
        judge("floor" + who, max(float(np.max(f.widest(n) - p[n][:, 1])) for n in f.names), BARS["floor"])
        drift, sliding = feet(f, p, fps)
        judge("drift" + who, drift, BARS["drift"])
        judge("sliding" + who, sliding, BARS["slide_percent"])
        if f.stands and not f.contacts:
            missed.append("no contact" + who)
        stretch = max(float(np.abs(np.linalg.norm(p[n] - p[f.parent[n]], axis=-1) / f.length[n] - 1).max()) for n in f.outer if "shoulder" not in n)
        judge("length_percent" + who, 100 * stretch, BARS["length_percent"])
        own = jerk(f, p, fps)
        judge("jerk" + who, own / max(max(jerks), 1e-9), 1.5)
        judge("jerk of own" + who, own / max(jerks[k], 1e-9), 0.5, least=True)
        tagged = {n for t in report["tangles"] for n in f.route(*t[f.f])}
        free = [n for n in f.names[1:] if n not in tagged] or f.names[1:]
        judge("pose_cm" + who, pose_error_cm(f, p, q, free), BARS["pose_cm"])
        for n in ["left_ankle", "right_ankle", "head"] + [w for w in ("left_wrist", "right_wrist") if w not in tagged]:
            is_, was = travel(p, n), [travel(s, n) for s in source]
            if is_ < 0.6 * was[k]:
                missed.append(f"lively {n}{who} {is_ / was[k]:.2f}")
            if is_ > 1.6 * max(was):
                missed.append(f"restless {n}{who} {is_ / max(was):.2f}")
    worse = []
    if result["lost"] > baseline["lost"]:
        worse.append(f"tags lost in {result['lost']} frames, not {baseline['lost']}")
    if result["through"] > baseline["through"]:
        worse.append(f"{result['through']} pass-throughs, not {baseline['through']}")
    if result["depth"].max() > max(BARS["penetration"], baseline["depth"].max() + 0.001):
        worse.append(f"{100 * result['depth'].max():.1f} cm deep, not {100 * baseline['depth'].max():.1f}")
    return {**out, "missed": missed, "worse": worse, "requirements": [r["name"] for r in report["requirements"] if not r["met"]]}


def main():
    bad = 0
    for folder in sys.argv[1:]:
        e = evaluate(folder)
        bad += bool(e["missed"]) or e["exit"] != 0
        print(f"{pathlib.Path(folder).name}: exit {e['exit']}, s GLI {e['gli']:.3f}, {100 * e['penetration']:.2f} cm deep, hold {100 * e['hold']:.2f} cm, "
              f"pose {e['pose_cm a']:.1f} {e['pose_cm b']:.1f} cm; missed: {'; '.join(e['missed']) or 'nothing'}; worse: {'; '.join(e['worse']) or 'no'}")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
