#!/usr/bin/env python3
"""Every shipped hold with real clips on both sides, which nobody made for it: mixed sizes, spins, other instants.

    tools/bench/real_matrix.py [--retarget BINARY] [--clips FOLDER] [--out FOLDER] [--label NAME] [--only TEXT ...]
                               [--every N] [--jobs N] [--table LABEL ...]

The rows follow from a seed. Each is one run with default settings, judged by common_bars.py from the files that it
wrote (pose error up to 12 cm). Results go to OUT/LABEL.jsonl, a line per row; rows that are there already are not
run again. --table prints the results of these labels beside each other, as in docs/real_clips.md, and runs nothing.
FOLDER holds the reference clips (default: ../shared/data/clips). Exit code 1 where a row is neither right nor told
beforehand that its clips do not fit. Needs numpy.
"""
import argparse
import concurrent.futures
import json
import math
import pathlib
import random
import re
import shutil
import subprocess
import sys

import common_bars
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
SEED = 20070
PER_HOLD = 7
HOLDS = ["argentine_backbreaker", "bear_hug", "fireman_carry", "full_nelson", "hug", "octopus_hold", "piggyback", "rear_choke", "supported_walk"]
# Of each clip: seconds, and the first that is motion (before it a T-pose, or the figure walks in).
CLIPS = {
    "bandai_respond_normal_001": (3.5, 0), "bandai_walk_normal_001": (6.4, 0), "cmu_12_01_walk": (4.3, 0.02), "cmu_131_01": (8.2, 0),
    "cmu_16_15": (3.9, 0), "fair_dab": (11.2, 1.4), "iclone_007_01_walk": (2.6, 0), "lafan_dance1_subject2": (131, 6),
    "mixamo_freebvh": (2.2, 0), "mocapbank": (15.1, 0), "xsens_stand": (11.5, 0),
}
# Figures that are carried: no clip of the library lies over a shoulder, so three rows of four have the hold's own.
CARRIED = {"argentine_backbreaker": 1, "fireman_carry": 1, "octopus_hold": 0, "piggyback": 1}
OWN = "own"
LONGEST, SHORTEST = 6.0, 2.0  # s of a row
WHAT = ["plain", "plain", "sizes", "instants", "instants and sizes", "spin", "spin and sizes"]


def rows():
    """Name and everything that a row depends on."""
    out = []
    for hold in HOLDS:
        chance = random.Random(f"{SEED} {hold}")
        for k, what in enumerate(WHAT[:PER_HOLD]):
            pair = chance.sample(sorted(CLIPS), 2)
            start = [CLIPS[c][1] for c in pair]
            if "instants" in what:
                start = [s + chance.uniform(0, max(0.0, min(CLIPS[c][0], 40) - s - SHORTEST)) for c, s in zip(pair, start)]
            stature = [chance.uniform(0.85, 1.15) if "sizes" in what else 1.0 for _ in pair]
            spin = [chance.choice([-1, 1]) * chance.uniform(90, 270) if "spin" in what and f == k % 2 else 0.0 for f in range(2)]
            if hold in CARRIED and len(out) % 4:
                f = CARRIED[hold]
                pair[f], start[f], spin[f] = OWN, 0.0, 0.0
            length = min([LONGEST] + [CLIPS[c][0] - s for c, s in zip(pair, start) if c != OWN])
            out.append({"name": f"{hold}/{k + 1} {what}", "hold": hold, "pair": pair, "start": start, "stature": stature, "spin": spin, "frames": int(30 * length)})
    return out


# -- A clip that turns as it goes ------------------------------------------------------------------


def axis_turn(axis, degrees):
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.array({"X": [[1, 0, 0], [0, c, -s], [0, s, c]], "Y": [[c, 0, s], [0, 1, 0], [-s, 0, c]], "Z": [[c, -s, 0], [s, c, 0], [0, 0, 1]]}[axis])


def euler(m, order):
    """Degrees of the rotations about the axes of `order` whose product is m."""
    i, j, k = ("XYZ".index(a) for a in order)
    sign = 1 if (i, j, k) in ((0, 1, 2), (1, 2, 0), (2, 0, 1)) else -1
    middle = math.asin(max(-1, min(1, sign * m[i, k])))
    return [math.degrees(x) for x in (math.atan2(-sign * m[j, k], m[k, k]), middle, math.atan2(-sign * m[i, j], m[i, i]))]


def write_spinning(source, out, degrees, first_s, last_s, up):
    """The BVH clip, turned by `degrees` about the vertical through its first root while it plays from first_s to last_s."""
    lines = source.read_text().splitlines()
    motion = next(i for i, line in enumerate(lines) if line.strip() == "MOTION")
    channels = next(line for line in lines if "CHANNELS" in line).split()[2:8]
    turns = [c[0] for c in channels if c.endswith("rotation")]
    step = float(lines[motion + 2].split(":")[1])
    numbers = [line.split() for line in lines[motion + 3:] if line.strip()]
    at = {c: k for k, c in enumerate(channels)}
    begin = min(int(first_s / step), len(numbers) - 1)
    origin = np.array([float(numbers[begin][at[a + "position"]]) for a in "XYZ"])
    for t, row in enumerate(numbers):
        share = min(1.0, max(0.0, (t * step - first_s) / (last_s - first_s)))
        turn = axis_turn(up, degrees * share)
        place = turn @ (np.array([float(row[at[a + "position"]]) for a in "XYZ"]) - origin) + origin
        m = turn
        for a in turns:
            m = m @ axis_turn(a, float(row[at[a + "rotation"]]))
        for a, x in zip("XYZ", place):
            row[at[a + "position"]] = f"{x:.6f}"
        for a, x in zip(turns, euler(m, turns)):
            row[at[a + "rotation"]] = f"{x:.6f}"
    out.write_text("\n".join(lines[:motion + 3] + [" ".join(row) for row in numbers]) + "\n")


# -- Running -------------------------------------------------------------------------------------


def told_of(binary, clip):
    """Stature (m) and up axis as the program finds them."""
    told = subprocess.run([binary, "inspect", str(clip), "--json"], capture_output=True, text=True)
    stature, up = re.search(r"stature ([\d.]+) m, ([yz]) up", json.loads(told.stdout)["human"]).groups()
    return float(stature), up.upper()


def unfit(report):
    """What the program said beforehand of clips that do not fit, empty where they do."""
    fit = report.get("clip_fit") or {}
    return [f"{f}: {fit[f]['sentence']}" for f in "ab" if f in fit and not fit[f]["fits"]]


def run(row, options):
    folder = options.out / options.label / row["name"].replace("/", "_").replace(" ", "_")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    arguments = [options.retarget, "--template", str(ROOT / "data/holds" / row["hold"] / "template.yaml"), "--frames", f"0:{row['frames']}"]
    for f, k in (("a", 0), ("b", 1)):
        own = ROOT / "data/holds" / row["hold"] / f"{f}.bvh"
        clip = own if row["pair"][k] == OWN else options.clips / f"{row['pair'][k]}.bvh"
        stature, up = told_of(options.retarget, clip)
        if row["spin"][k]:
            spun = folder / f"spun_{f}.bvh"
            write_spinning(clip, spun, row["spin"][k], row["start"][k], row["start"][k] + row["frames"] / 30, up)
            clip = spun
        arguments += [f"--clip-{f}", str(clip), f"--start-{f}", f"{row['start'][k]:.3f}"]
        if row["stature"][k] != 1:
            arguments += [f"--stature-{f}", f"{row['stature'][k] * stature:.3f}"]
    done = subprocess.run(arguments + ["--out", str(folder), "--force"], capture_output=True, text=True)
    result = {"row": row["name"], "exit": done.returncode, "command": " ".join(arguments[1:])}
    try:
        result.update(common_bars.evaluate(folder))
        report = json.loads((folder / "report.json").read_text())
        result.update(unfit=unfit(report), solve_s=report["timings"]["solve_s"])
    except FileNotFoundError:
        result.update(missed=[done.stderr.strip().splitlines()[-1] if done.stderr.strip() else "no report"], worse=[], unfit=[], requirements=[])
    if not options.keep:
        shutil.rmtree(folder, ignore_errors=True)
    return result


def verdict(result):
    """Right: exit 0 and all common bars. Told: it was said beforehand that the clips do not fit, and exit 3 followed."""
    if result["exit"] == 0 and not result["missed"]:
        return "right"
    return "told" if result.get("unfit") and result["exit"] == 3 else "wrong"


def read(path):
    return {r["row"]: r for r in map(json.loads, path.read_text().splitlines())} if path.exists() else {}


def cells(result):
    if result is None:
        return ["", "", ""]
    why = result["missed"] if result["missed"] else [] if result["exit"] == 0 else result["requirements"]
    if verdict(result) == "told":
        why = result["unfit"]
    shown = "; ".join(why[:3]) + (f"; {len(why) - 3} more" if len(why) > 3 else "")
    return [f"{verdict(result)}, exit {result['exit']}", shown, "; ".join(result["worse"])]


def table(options):
    results = [read(options.out / f"{label}.jsonl") for label in options.table]
    print("| row | clips | " + " | ".join(f"{label} | misses | worse than its baseline" for label in options.table) + " |")
    print("|---" * (2 + 3 * len(options.table)) + "|")
    shown = [r for r in rows() if any(r["name"] in have for have in results)]
    for row in shown:
        said = [f"{c} {100 * h:.0f} %" if h != 1 else c for c, h in zip(row["pair"], row["stature"])]
        print(f"| {row['name']} | {' x '.join(said)} | " + " | ".join(" | ".join(cells(have.get(row["name"]))) for have in results) + " |")
    print()
    for label, have in zip(options.table, results):
        count = {v: sum(verdict(r) == v for r in have.values()) for v in ("right", "told", "wrong")}
        through = sum(r.get("pass-throughs", 0) > 0 for r in have.values())
        print(f"{label}: of {len(have)} rows {count['right']} right, {count['told']} told beforehand, {count['wrong']} wrong; "
              f"{sum(bool(r['worse']) for r in have.values())} worse than their baseline, {through} with pass-throughs")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--retarget", default=str(ROOT / "build/release/retarget"))
    parser.add_argument("--clips", type=pathlib.Path, default=ROOT.parent / "shared/data/clips")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/real_matrix")
    parser.add_argument("--label", default="now")
    parser.add_argument("--only", nargs="*", help="rows whose name contains one of these")
    parser.add_argument("--every", type=int, default=1, help="every Nth row")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--keep", action="store_true", help="keep what the runs wrote")
    parser.add_argument("--table", nargs="+", metavar="LABEL")
    options = parser.parse_args()
    if options.table:
        table(options)
        return 0
    options.out.mkdir(parents=True, exist_ok=True)
    path = options.out / f"{options.label}.jsonl"
    have = read(path)
    chosen = [r for r in rows()[::options.every] if not options.only or any(text in r["name"] for text in options.only)]
    wrong = 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for result in pool.map(lambda row: have.get(row["name"]) or run(row, options), chosen):
            if result["row"] not in have:
                with path.open("a") as file:
                    file.write(json.dumps(result) + "\n")
            wrong += verdict(result) == "wrong"
            print(f"{result['row']}: " + " | ".join(cells(result)), flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
