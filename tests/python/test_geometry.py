"""gli and tangles against the golden vectors and the command line."""

import json
import os
import pathlib
import subprocess

import numpy as np
import pytest

import retarget

GOLDEN = pathlib.Path(os.environ["RETARGET_SOURCE_DIR"]) / "tests" / "data" / "golden"


def golden(name):
    return json.loads((GOLDEN / name).read_text())


def test_gli_of_the_golden_segments():
    pairs = golden("segment_pairs.json")
    assert len(pairs) == 100
    for pair in pairs:
        p, q = np.array([pair["a"], pair["b"]]), np.array([pair["c"], pair["d"]])
        exact = float(pair["gli"])
        assert abs(retarget.gli(p, q) - exact) < 1e-12, pair["id"]
        value, d_p, d_q = retarget.gli(p, q, gradient=True)
        assert abs(value - exact) < 1e-12
        expected = np.array(pair["grad"], dtype=float).reshape(4, 3)
        assert np.abs(np.concatenate([d_p, d_q]) - expected).max() < 1e-9 * np.abs(expected).max()


def test_gli_of_closed_curves_is_their_linking_number():
    curves = golden("curves.json")
    assert curves
    for curve in curves:
        p, q = np.array(curve["curve1"]), np.array(curve["curve2"])
        value = retarget.gli(np.vstack([p, p[:1]]), np.vstack([q, q[:1]]))
        assert abs(value - curve["lk"]) < 1e-12, curve["name"]


@pytest.mark.parametrize("shape", [(3,), (1, 3), (4, 2), (2, 2, 3)])
def test_gli_refuses_other_shapes(shape):
    with pytest.raises(retarget.InputError):
        retarget.gli(np.zeros(shape), np.ones((2, 3)))
    with pytest.raises(retarget.InputError, match="not finite"):
        retarget.gli([[0, 0, float("nan")], [0, 0, 1]], np.ones((2, 3)))


def printed(path):
    return json.loads(
        subprocess.run([os.environ["RETARGET_BINARY"], "tangles", str(path), "--json"],
                       capture_output=True, check=True, text=True).stdout
    )


def test_tangles_equal_the_command_lines(hold, tmp_path):
    template = retarget.Template(hold[2])
    expected = printed(hold[2])
    assert retarget.tangles(template) == retarget.tangles(template.text) == expected
    assert len(expected["tags"]) >= 1
    one = retarget.tangles(template, settings={"tangle.max_tags": 1})
    assert len(one["tags"]) == 1

    posture = golden("postures.json")[0]
    path = tmp_path / "p.json"
    path.write_text(json.dumps({"A": posture["A"], "B": posture["B"]}))
    found = retarget.tangles(posture["A"], np.array(posture["B"]))
    assert found == printed(path)
    with pytest.raises(retarget.InputError, match="21 node positions"):
        retarget.tangles(np.zeros((20, 3)), np.zeros((21, 3)))


def test_template_and_settings_are_plain_values(hold):
    template = retarget.Template(pathlib.Path(hold[2]))
    assert template.name and template.positions["a"].shape == (21, 3)
    defaults = retarget.default_settings()
    assert defaults["weights"]["tangle"] == 20
    assert defaults["solve"]["backend"] == "banded"
    # The defaults are settings themselves.
    retarget.tangles(template, settings=defaults)
