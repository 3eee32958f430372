"""Ratios out of the benchmarks' JSON, which say more than times on a machine that is shared.

  summary.py reports SHORT/report.json LONG/report.json
  summary.py kernels kernels.json
"""
import json
import sys


def read(path):
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def reports(short_path, long_path):
    runs = [read(short_path), read(long_path)]
    print(f"{'frames':>7} {'start s':>8} {'solve s':>8} {'frames/s':>9} {'iter':>5} {'linear':>7} "
          f"{'peak MB':>8} {'kB/frame':>9} {'exit':>5}")
    for r in runs:
        t, peak = r["timings"], r["memory"]["peak_bytes"]
        print(f"{r['frames']:>7} {t['start_s']:>8.2f} {t['solve_s']:>8.2f} "
              f"{t['frames_per_s']:>9.1f} {r['solve']['iterations']:>5} "
              f"{r['solve']['linear_solves']:>7} {peak / 1e6:>8.1f} "
              f"{peak / 1e3 / r['frames']:>9.1f} {r['exit_code']:>5}")
    a, b = runs
    added = b["frames"] - a["frames"]
    peak = [r["memory"]["peak_bytes"] for r in runs]
    cost = [r["timings"]["solve_s"] / r["frames"] for r in runs]
    linear = [c / r["solve"]["linear_solves"] for c, r in zip(cost, runs)]
    share = [p / r["frames"] for p, r in zip(peak, runs)]
    print(f"long to short, per frame: solve {cost[1] / cost[0]:.2f}x, per linear solve "
          f"{linear[1] / linear[0]:.2f}x, peak {share[1] / share[0]:.2f}x; "
          f"memory between them {(peak[1] - peak[0]) / 1e6 / added:.3f} MB/frame")


def kernels(path):
    by_name = {b["name"]: b for b in read(path)["benchmarks"]}

    def ratio(name, to, key="cpu_time"):
        return f"{by_name[name][key] / by_name[to][key]:.2f}"

    multiply = "DenseMultiply/264/120"
    for name, b in by_name.items():
        if "GFLOP/s" in b and name != multiply:
            print(f"{name}: {ratio(name, multiply, 'GFLOP/s')} of the dense multiply's rate")
    print("detection, definition to Algorithm 1:", ratio("DetectionByDefinition", "Detection"))
    print("segment GLI, with gradient to value:", ratio("SegmentGliAndGradient", "SegmentGliValue"))


if __name__ == "__main__":
    commands = {"reports": reports, "kernels": kernels}
    if len(sys.argv) < 3 or sys.argv[1] not in commands:
        sys.exit(__doc__)
    commands[sys.argv[1]](*sys.argv[2:])
