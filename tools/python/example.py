"""Solves a shipped hold and plots s GLI of its tags over time: example.py HOLD_FOLDER PLOT.png

Needs matplotlib (python3-matplotlib).
"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import retarget


def main(folder, picture):
    result = retarget.run(
        f"{folder}/a.bvh",
        f"{folder}/b.bvh",
        f"{folder}/template.yaml",
        page=False,
        progress=lambda i: print(f"{i['iteration']:4} cost {i['cost']:.3f}", file=sys.stderr),
    )
    print(result.status)
    figure, axes = plt.subplots(figsize=(8, 3.5))
    for label, motions in (("simulated", result.baseline), ("solved", result.solved)):
        a, b = motions["a"], motions["b"]
        time = np.arange(len(a)) / a.fps
        for tangle in result.report["tangles"]:
            sign = np.sign(tangle["template_gli"])
            paths = [path_of(tangle[f], m.nodes) for f, m in (("a", a), ("b", b))]
            gli = [
                sign * retarget.gli(a.positions[t, paths[0]], b.positions[t, paths[1]])
                for t in range(len(a))
            ]
            axes.plot(time, gli, label=f"{label}: {' to '.join(tangle['a'])}")
    axes.axhline(0.5, color="black", linestyle="--")
    axes.set(xlabel="s", ylabel="s GLI (turns)")
    axes.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(picture, dpi=120)


PARENTS = [-1, 0, 1, 2, 3, 2, 5, 6, 7, 2, 9, 10, 11, 0, 13, 14, 15, 0, 17, 18, 19]


def path_of(ends, nodes):
    """Nodes from one end to the other, through the tree of the body."""
    up = []
    for end in ends:
        node, line = nodes.index(end), []
        while node >= 0:
            line.append(node)
            node = PARENTS[node]
        up.append(line)
    common = next(node for node in up[0] if node in up[1])
    return up[0][: up[0].index(common) + 1] + up[1][: up[1].index(common)][::-1]


main(*sys.argv[1:])
