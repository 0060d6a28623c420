# SPDX-License-Identifier: BSD-3-Clause
"""The programs of docs/how-to/publish.md, as they stand there."""

import csv
import os
import shutil
import subprocess
import sys
import time

import pytest

from document import code_blocks


def rows_of(run):
    with open(run / "states.csv") as file:
        return list(csv.DictReader(file))


def track(tool, recording, output, port):
    """Begins a run that takes a second, and so leaves programs the time to connect."""
    return subprocess.Popen(
        [tool, "track", "--model", "rigid_block", "--source", recording, "--output", output,
         "--initial-state", recording / "groundtruth.csv", "--realtime",
         "--publish", f"tcp:{port}"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def wait_for_server(process):
    """Readers may connect once its address is said."""
    for line in process.stderr:
        if line.startswith("publishing:"):
            return
    pytest.fail("the tool has not said where it publishes")


def program(docs, number, port):
    code = code_blocks(docs / "how-to" / "publish.md", "python")[number]
    assert "5555" in code
    return [sys.executable, "-c", code.replace("5555", str(port))]


def test_commands_run(tool, recording, docs, free_port, tmp_path):
    pipe, socket = (block.strip() for block in code_blocks(docs / "how-to" / "publish.md", "sh"))
    assert "--publish stdout |" in pipe and "--publish tcp:" in socket
    (tmp_path / "lockbox").symlink_to(tool)
    (tmp_path / "my_program.py").write_text("import sys\nprint(len(list(sys.stdin)))\n")
    environment = {**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}"}

    def run(command):
        own = {"openni2:": str(recording), "cabinet": "rigid_block", "5555": str(free_port)}
        for told, given in own.items():
            command = command.replace(told, given)
        return subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=tmp_path, text=True,
                              env=environment, capture_output=True)

    read, served = run(pipe), run(socket)
    assert read.returncode == 0 and int(read.stdout) == 30, read.stderr
    assert served.returncode == 0 and f"{free_port}" in served.stderr, served.stderr


def test_client_reads_every_frame_once_it_is_connected(tool, recording, docs, free_port, tmp_path):
    run = track(tool, recording, tmp_path / "run", free_port)
    wait_for_server(run)
    client = subprocess.run(program(docs, 0, free_port), capture_output=True, text=True,
                            check=True)
    run.communicate()
    assert run.returncode == 0
    rows = rows_of(tmp_path / "run")
    lines = client.stdout.splitlines()
    assert len(lines) > 3
    assert [line.split()[:2] for line in lines] == [
        [repr(float(row["timestamp"])), row["status"]] for row in rows[-len(lines):]]


def test_bridge_publishes_to_ros(tool, recording, docs, free_port, tmp_path):
    rospy = pytest.importorskip("rospy")
    from geometry_msgs.msg import PoseWithCovarianceStamped
    from sensor_msgs.msg import JointState

    master = shutil.which("rosmaster")
    if master is None:
        pytest.skip("there is no rosmaster")
    master_port = str(free_port + 1)
    os.environ["ROS_MASTER_URI"] = "http://127.0.0.1:" + master_port
    os.environ["ROS_IP"] = "127.0.0.1"
    os.environ["ROS_LOG_DIR"] = str(tmp_path / "log")
    core = subprocess.Popen([master, "--core", "-p", master_port], stdout=subprocess.DEVNULL,
                            stderr=subprocess.DEVNULL)
    joints, poses = [], []
    try:
        wait_for_master(rospy)
        rospy.init_node("listener", disable_signals=True)
        rospy.Subscriber("joint_states", JointState, joints.append)
        rospy.Subscriber("base_pose", PoseWithCovarianceStamped, poses.append)
        run = track(tool, recording, tmp_path / "run", free_port)
        wait_for_server(run)
        subprocess.run(program(docs, 1, free_port), check=True)
        run.communicate()
        time.sleep(0.3)  # for what is on its way
    finally:
        rospy.signal_shutdown("done")
        core.terminate()
        core.wait()
    assert len(poses) > 2 and len(joints) > 2  # a busy machine joins late
    position = poses[-1].pose.pose.position
    by_time = {round(float(row["timestamp"]), 6): row for row in rows_of(tmp_path / "run")}
    row = by_time[round(poses[-1].header.stamp.to_sec(), 6)]
    assert [position.x, position.y, position.z] == [float(row[c]) for c in ("tx", "ty", "tz")]
    assert poses[-1].header.frame_id == "camera_depth_optical_frame"
    assert len(poses[-1].pose.covariance) == 36 and poses[-1].pose.covariance[0] > 0


def wait_for_master(rospy):
    import rosgraph
    for _ in range(200):
        if rosgraph.is_master_online():
            return
        time.sleep(0.05)
    pytest.fail("rosmaster does not answer")
