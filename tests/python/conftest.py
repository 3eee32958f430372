"""Where the tests find the program and the data; CTest sets the variables."""

import os
import pathlib
import subprocess
import sys

import pytest

SOURCE = pathlib.Path(os.environ["RETARGET_SOURCE_DIR"])
sys.path.insert(0, str(SOURCE / "tests"))
HOLD = SOURCE / "data" / "holds" / "bear_hug"


@pytest.fixture
def hold():
    """Paths of the clips and the template of a shipped hold."""
    return str(HOLD / "a.bvh"), str(HOLD / "b.bvh"), str(HOLD / "template.yaml")


@pytest.fixture
def program(tmp_path):
    """Runs the command line: (arguments) -> folder with the results, for --out."""

    def run(*arguments):
        out = tmp_path / "program"
        done = subprocess.run(
            [os.environ["RETARGET_BINARY"], *map(str, arguments), "--out", str(out)],
            capture_output=True,
            text=True,
            timeout=250,
        )
        assert done.returncode in (0, 3), done.stderr
        return out

    return run
