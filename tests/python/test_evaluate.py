# SPDX-License-Identifier: BSD-3-Clause
"""Errors as the tool gives them."""

import json
import subprocess

import pytest

import lockbox


def test_evaluation_is_that_of_the_tool(tool, recording, tmp_path):
    run = tmp_path / "run"
    subprocess.run([tool, "track", "--model", "rigid_block", "--source", recording, "--quiet",
                    "--initial-state", recording / "groundtruth.csv", "--output", run], check=True)
    truth = recording / "groundtruth.csv"
    subprocess.run([tool, "evaluate", "--estimate", run / "states.csv", "--reference", truth,
                    "--output", tmp_path / "errors"], check=True, capture_output=True)
    summary = json.loads((tmp_path / "errors" / "summary.json").read_text())
    assert lockbox.evaluate(run / "states.csv", truth) == summary
    model = lockbox.load_model("rigid_block")
    assert lockbox.evaluate(run / "states.csv", truth, model=model) == summary
    assert summary["base"]["translation"]["rmse"] < 0.01
    with pytest.raises(lockbox.InputError, match="none.csv: there is no such file"):
        lockbox.evaluate(tmp_path / "none.csv", truth)
