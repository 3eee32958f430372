#!/usr/bin/env python3
"""How the shipped holds do with clips they were not made for, other sizes, and mirrored.

    tools/bench/holds_matrix.py [--retarget BINARY] [--clips FOLDER] [--only HOLD ...]

Every row is one run of `retarget` with default settings. FOLDER holds the reference clips
(default: ../shared/data/clips); rows that need them are left out where it is absent. Mirrored rows
have mirrored clips and a mirrored template. Exit code 1 where a row misses a requirement.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Reference clips that suit a hold, a and b; "own" is the shipped clip.
REAL = {
    "argentine_backbreaker": [("lafan_dance1_subject2", "own"), ("xsens_stand", "own"), ("mocapbank", "own"), ("lafan_dance1_subject2", "xsens_stand")],
    "bear_hug": [("xsens_stand", "lafan_dance1_subject2"), ("lafan_dance1_subject2", "xsens_stand"), ("mocapbank", "xsens_stand"), ("bandai_respond_normal_001", "xsens_stand")],
    "fireman_carry": [("bandai_walk_normal_001", "own"), ("cmu_16_15", "own"), ("bandai_walk_normal_001", "xsens_stand"), ("lafan_dance1_subject2", "bandai_respond_normal_001")],
    "full_nelson": [("fair_dab", "bandai_respond_normal_001"), ("lafan_dance1_subject2", "xsens_stand"), ("lafan_dance1_subject2", "bandai_respond_normal_001"), ("xsens_stand", "bandai_respond_normal_001"), ("mocapbank", "mixamo_freebvh"), ("cmu_16_15", "cmu_12_01_walk")],
    "hug": [("xsens_stand", "lafan_dance1_subject2"), ("lafan_dance1_subject2", "xsens_stand"), ("mocapbank", "xsens_stand")],
    "octopus_hold": [("fair_dab", "bandai_respond_normal_001"), ("xsens_stand", "lafan_dance1_subject2"), ("lafan_dance1_subject2", "xsens_stand"), ("bandai_respond_normal_001", "lafan_dance1_subject2")],
    "piggyback": [("cmu_131_01", "own"), ("bandai_walk_normal_001", "own"), ("bandai_walk_normal_001", "xsens_stand"), ("lafan_dance1_subject2", "bandai_respond_normal_001")],
    "rear_choke": [("fair_dab", "bandai_respond_normal_001"), ("xsens_stand", "lafan_dance1_subject2"), ("lafan_dance1_subject2", "xsens_stand"), ("mocapbank", "xsens_stand")],
    "supported_walk": [("cmu_12_01_walk", "cmu_16_15"), ("bandai_walk_normal_001", "cmu_16_15"), ("iclone_007_01_walk", "cmu_12_01_walk"), ("cmu_131_01", "bandai_walk_normal_001")],
}
# A T-pose stands at the beginning of these, and is no motion.
T_POSE = {"cmu_12_01_walk": 1, "fair_dab": 42}
START = {"lafan_dance1_subject2": 6}  # s; before that he walks in
SIZES = [(0.8, 1), (1.2, 1), (1, 0.8), (1, 1.2)]


def run(binary, folder, arguments):
    """The report of one run, or the one line that says why there is none."""
    done = subprocess.run([binary, *arguments, "--json", "--out", folder, "--force"], capture_output=True, text=True)
    try:
        return json.loads(done.stdout)
    except ValueError:
        return done.stderr.strip().splitlines()[-1] if done.stderr.strip() else f"exit {done.returncode}"


def cells(report):
    """Exit code, smallest s GLI, penetration and hold error (cm), pose error (cm), what is missed."""
    if isinstance(report, str):
        return ["2", "", "", "", "", report]
    m = report["metrics"]["result"]
    missed = [f"{r['name']} {r['value']:.3g}" for r in report["requirements"] if not r["met"]]
    return [
        str(report["exit_code"]),
        f"{m['smallest_gli_between_frames']:.2f}",
        f"{100 * m['penetration_m']:.2f}",
        f"{100 * max(m['hold_m'] or [0]):.2f}",
        f"{max(m[f]['pose_error_cm'] for f in 'ab'):.1f}",
        "; ".join(missed),
    ]


def rows(binary, hold, clips, scratch):
    """Yields (what, cells)."""
    folder = ROOT / "data/holds" / hold
    own = ["--clip-a", f"{folder}/a.bvh", "--clip-b", f"{folder}/b.bvh"]
    template = ["--template", f"{folder}/template.yaml"]
    out = f"{scratch}/out"
    report = run(binary, out, own + template)
    yield "own clips", cells(report)
    stature = [report["bodies"][f]["stature_m"] for f in "ab"] if not isinstance(report, str) else [1.75, 1.75]
    for shares in SIZES:
        sizes, said = [], []
        for f, share, height in zip("ab", shares, stature):
            if share != 1:
                sizes += [f"--stature-{f}", f"{share * height:.3f}"]
                said.append(f"{f} at {share}x")
        yield ", ".join(said), cells(run(binary, out, own + template + sizes))
    for f in "ab":
        subprocess.run([binary, "mirror", f"{folder}/{f}.bvh", "--out", f"{scratch}/{f}.bvh", "--force"], check=True, capture_output=True)
    subprocess.run([binary, "pose", f"{folder}/template.yaml", "--mirror", "both", "--out", f"{scratch}/t.yaml", "--force"], check=True, capture_output=True)
    mirrored = ["--clip-a", f"{scratch}/a.bvh", "--clip-b", f"{scratch}/b.bvh", "--template", f"{scratch}/t.yaml"]
    yield "mirrored", cells(run(binary, out, mirrored))
    if not clips.is_dir():
        return
    for pair in REAL[hold]:
        arguments = list(template)
        for f, name in zip("ab", pair):
            arguments += [f"--clip-{f}", f"{folder}/{f}.bvh" if name == "own" else f"{clips}/{name}.bvh"]
            if name in T_POSE:
                arguments += [f"--skip-frames-{f}", str(T_POSE[name])]
            if name in START:
                arguments += [f"--start-{f}", str(START[name])]
        if any(name in ("xsens_stand", "lafan_dance1_subject2") for name in pair):
            arguments += ["--frames", "0:100" if any("respond" in name for name in pair) else "0:240"]
        yield " x ".join(pair), cells(run(binary, out, arguments))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--retarget", default=f"{ROOT}/build/release/retarget")
    parser.add_argument("--clips", type=pathlib.Path, default=ROOT.parent / "shared/data/clips")
    parser.add_argument("--only", nargs="*", default=sorted(REAL))
    options = parser.parse_args()
    missed = 0
    print("| hold | run | exit | s GLI | penetration, cm | hold, cm | pose, cm | missed |\n|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        for hold in options.only:
            for what, row in rows(options.retarget, hold, options.clips, scratch):
                print(f"| {hold} | {what} | " + " | ".join(row) + " |", flush=True)
                missed += row[0] != "0"
    return 1 if missed else 0


sys.exit(main())
