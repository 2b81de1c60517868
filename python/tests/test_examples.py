"""The examples run and make their plots."""

import glob
import os
import subprocess
import sys

import pytest

import penumbra

FOLDER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "examples")


@pytest.mark.parametrize("name", sorted(os.path.basename(path) for path in glob.glob(os.path.join(FOLDER, "*.py"))))
def test_example(name, tmp_path):
    pytest.importorskip("matplotlib")
    environment = {**os.environ, "PYTHONPATH": os.path.dirname(os.path.dirname(penumbra.__file__)), "MPLBACKEND": "Agg",
                   "MPLCONFIGDIR": str(tmp_path)}
    plot = tmp_path / "plot.png"
    done = subprocess.run([sys.executable, os.path.join(FOLDER, name), str(plot)], env=environment, capture_output=True,
                          text=True)
    assert done.returncode == 0, done.stderr
    assert plot.read_bytes().startswith(b"\x89PNG")
