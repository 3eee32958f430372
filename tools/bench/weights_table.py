#!/usr/bin/env python3
"""Whether weights do what their names say: the metric that each works for, at five values of it.

    tools/bench/weights_table.py [--retarget BINARY] [--only WEIGHT ...] [--scenes HOLD ...]

Ten weights at a tenth to ten times their default, all else default, on three shipped scenes of 2 s:
150 runs. A row is monotone where no step goes against the weight's direction by more than the metric's
grain (what is of no account: a tenth of a millimetre, a hundredth of a turn, one percent of a jerk). A
term whose hinge is satisfied at every value is said to be idle. Exit code 1 where a row is not
monotone.
"""
import argparse
import concurrent.futures
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ["bear_hug", "full_nelson", "supported_walk"]
FRAMES = "0:60"
FACTORS = [0.1, 0.3, 1, 3, 10]


def figures(metrics, key, combine=max):
    values = [metrics[f][key] for f in "ab" if metrics[f][key] is not None]
    return combine(values) if values else None


def mean(values):
    return sum(values) / len(values)


def off_template(report):
    """Largest distance of a tag's smallest s GLI to its template's value."""
    return max(abs(t["template_gli"]) - t["min_signed_gli"] for t in report["tangles"])


def root_cost(report):
    return next(t["natural_cost"] for t in report["solve"]["terms"] if t["term"] == "root_tracking") ** 0.5


def travel(report):
    """Of the swing that exceeds its source's by most."""
    m = report["metrics"]["result"]
    pairs = [(m[f]["near_floor_travel_m"], m[f]["near_floor_travel_source_m"]) for f in "ab"]
    return 100 * max(own - source for own, source in pairs if own is not None)


# Weight: (metric, unit, its value in a report, +1 where more weight means more of it, relative grain,
# absolute grain).
WEIGHTS = {
    "pose_tracking": ("joint edit", "deg", lambda r: figures(r["metrics"]["result"], "joint_edit_deg", mean), -1, 0.01, 0.01),
    "root_tracking": ("root off its target (root of the natural cost)", "m, rad", root_cost, -1, 0.01, 1e-3),
    "smoothness": ("mean jerk", "m/s^3", lambda r: figures(r["metrics"]["result"], "jerk_m_s3", mean), -1, 0.01, 0.01),
    "foot_lock": ("foot drift", "cm", lambda r: 100 * figures(r["metrics"]["result"], "foot_drift_m"), -1, 0.01, 0.01),
    "foot_swing": ("foot travel near the floor beyond the capture's", "cm", travel, -1, 0.01, 0.05),
    "hold": ("hold error", "cm", lambda r: 100 * max(r["metrics"]["result"]["hold_m"]), -1, 0.01, 0.01),
    "penetration": ("deepest penetration", "cm", lambda r: 100 * r["metrics"]["result"]["penetration_m"], -1, 0.01, 0.01),
    "tangle": ("smallest s GLI", "turns", lambda r: r["metrics"]["result"]["smallest_gli"], 1, 0, 0.01),
    "tangle_aim": ("s GLI off the template's, largest", "turns", off_template, -1, 0, 0.01),
    "hand_contact": ("gap of holding hands", "cm", lambda r: 100 * figures(r["metrics"]["result"], "holding_hand_gap_m"), -1, 0.01, 0.02),
}


def run(binary, scene, weight, value, folder):
    hold = ROOT / "data/holds" / scene
    command = [binary, "--clip-a", f"{hold}/a.bvh", "--clip-b", f"{hold}/b.bvh", "--template", f"{hold}/template.yaml"]
    command += ["--frames", FRAMES, "--set", f"weights.{weight}={value:g}", "--out", folder, "--force", "--json"]
    done = subprocess.run(command, capture_output=True, text=True)
    try:
        return json.loads(done.stdout)
    except ValueError:
        sys.exit(f"{scene}, weights.{weight}={value:g}: {done.stderr.strip()}")


def defaults(binary):
    """Of every weight, as `retarget config` prints them."""
    out, section = {}, ""
    for line in subprocess.run([binary, "config"], capture_output=True, text=True, check=True).stdout.splitlines():
        text = line.split("#")[0].rstrip()
        if text and not text.startswith(" "):
            section = text.rstrip(":")
        elif text and section == "weights":
            key, value = text.split(":")
            out[key.strip()] = float(value)
    return out


def is_idle(reports, weight):
    cost = lambda r: next(t["cost"] for t in r["solve"]["terms"] if t["term"] == weight)
    return all(cost(r) <= 1e-6 * r["solve"]["cost"] for r in reports)


def judged(values, direction, relative, absolute):
    """The first step against the direction, None where there is none."""
    for k in range(1, len(values)):
        step = direction * (values[k] - values[k - 1])
        if step < -max(absolute, relative * abs(values[k - 1])):
            return k
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--retarget", default=f"{ROOT}/build/release/retarget")
    parser.add_argument("--only", nargs="*", default=list(WEIGHTS), choices=list(WEIGHTS), metavar="WEIGHT")
    parser.add_argument("--scenes", nargs="*", default=SCENES, metavar="HOLD")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time")
    options = parser.parse_args()
    default = defaults(options.retarget)
    wrong = rows = 0
    heads = " | ".join(f"{f:g}x" for f in FACTORS)
    print(f"| weight (default) | metric, and where it goes | scene | {heads} | monotone |")
    print("|---|---|---|" + "---|" * len(FACTORS) + "---|")
    with tempfile.TemporaryDirectory() as scratch, concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for weight in options.only:
            metric, unit, value_of, direction, relative, absolute = WEIGHTS[weight]
            for scene in options.scenes:
                values = [factor * default[weight] for factor in FACTORS]
                reports = list(pool.map(lambda v: run(options.retarget, scene, weight, v, f"{scratch}/{v:g}"), values))
                values = [value_of(r) for r in reports]
                bad = judged(values, direction, relative, absolute)
                said = "yes" if bad is None else f"no, at {FACTORS[bad]:g}x"
                if bad is None and is_idle(reports, weight):
                    said = "idle"
                wrong += bad is not None
                rows += 1
                cells = " | ".join(f"{v:.3g}" for v in values)
                way = "up" if direction > 0 else "down"
                print(f"| `{weight}` ({default[weight]:g}) | {metric}, {unit}: {way} | {scene} | {cells} | {said} |", flush=True)
    print(f"\n{rows - wrong} of {rows} rows are monotone.")
    return 1 if wrong else 0


sys.exit(main())
