"""The node of bench/twin/ros_node.py beside a twin, with ROS's modules imagined: NODE RECORDING TWIN-COMMAND...

Poses of a laboratory's recording go in as messages. Fails unless each is answered by an estimate and the last one is that
of the twin's own table; prints how many fields were played, and the largest.
"""
import csv
import importlib.util
import json
import math
import pathlib
import re
import subprocess
import sys
import time
import types
from types import SimpleNamespace as Message

node_file, recording, *command = sys.argv[1:]
twin = subprocess.Popen([*command, "--listen", "0"], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
port = next(found.group(1) for line in twin.stderr if (found := re.search(r"127\.0\.0\.1:(\d+)", line)))


def stamp(time_s=0.0):
    return Message(**dict(zip(("sec", "nanosec"), divmod(round(1e9 * time_s), 10**9))))


def pose():
    return Message(position=Message(x=0.0, y=0.0, z=0.0), orientation=Message(x=0.0, y=0.0, z=0.0, w=1.0))


class Node:
    def __init__(self, name):
        self.published, self.subscribed, self.timers = {}, {}, []

    def declare_parameter(self, name, value):
        return Message(value=int(port))

    def create_publisher(self, kind, topic, depth):
        messages = self.published.setdefault(topic, [])
        return Message(publish=messages.append)

    def create_subscription(self, kind, topic, callback, depth):
        self.subscribed[topic] = callback

    def create_timer(self, period_s, callback):
        self.timers.append(callback)

    def get_clock(self):
        return Message(now=lambda: Message(nanoseconds=int(1e9 * self.now_s), to_msg=lambda: stamp(self.now_s)))


def module(name, **members):
    made = types.ModuleType(name)
    made.__dict__.update(members)
    sys.modules[name] = made


module("rclpy", init=lambda: None, spin=lambda node: None)
module("rclpy.node", Node=Node)
module("geometry_msgs")
module("geometry_msgs.msg", PoseStamped=object,
       PoseWithCovarianceStamped=lambda: Message(header=Message(stamp=stamp()), pose=Message(pose=pose(), covariance=None)),
       Vector3Stamped=lambda: Message(header=Message(stamp=None), vector=Message(x=0.0, y=0.0, z=0.0)))
module("std_msgs")
module("std_msgs.msg", String=Message)

spec = importlib.util.spec_from_file_location("ros_node", node_file)
ros_node = importlib.util.module_from_spec(spec)
spec.loader.exec_module(ros_node)
node = ros_node.TwinNode()
frames = [line for line in map(json.loads, open(recording)) if line["type"] == "frame"]
for n, frame in enumerate(frames, 1):
    seen = pose()
    seen.position.x, seen.position.y = frame["x_m"], frame["y_m"]
    seen.orientation.z, seen.orientation.w = math.sin(0.5 * frame["angle_rad"]), math.cos(0.5 * frame["angle_rad"])
    node.now_s = frame["time_s"]
    node.subscribed["pose"](Message(header=Message(stamp=stamp(frame["time_s"])), pose=seen))
    for _ in range(2000):  # as a camera would, which is slower than the twin
        if len(node.published["estimate"]) >= n:
            break
        time.sleep(0.001)
    for callback in node.timers:
        callback()
print(json.dumps({"type": "end"}), file=node.stream, flush=True)
twin.wait(60)
last = node.published["estimate"][-1].pose
folder = pathlib.Path(command[command.index("--output") + 1])
row = list(csv.DictReader((folder / "twin.csv").open()))[-1]
angle_rad = 2.0 * math.atan2(last.pose.orientation.z, last.pose.orientation.w)
if len(node.published["estimate"]) != len(frames) or twin.returncode != 0:
    sys.exit(f"{len(node.published['estimate'])} estimates of {len(frames)} frames, exit code {twin.returncode}")
for key, value in (("x_m", last.pose.position.x), ("y_m", last.pose.position.y), ("angle_rad", angle_rad)):
    if abs(float(row[key]) - value) > 1e-9:
        sys.exit(f"{key} = {value}, and {row[key]} in the table")
fields = list(node.published["field"])
node.samples = [[1.0, 0.0, 1e-3], [1.1, 1e-3, -1e-3], [1.2, 2e-3, -1e-3]]  # linear in between, held outside
for now_s, wanted in ((0.9, (0.0, 1e-3)), (1.025, (2.5e-4, 5e-4)), (1.15, (1.5e-3, -1e-3)), (1.3, (2e-3, -1e-3))):
    node.now_s = now_s
    node.play()
    played = node.published["field"][-1].vector
    if math.hypot(played.x - wanted[0], played.y - wanted[1]) > 1e-10:  # the clock counts nanoseconds
        sys.exit(f"at {now_s} s ({played.x}, {played.y}) T is played instead of {wanted}")
print(len(fields) > 0, max((math.hypot(f.vector.x, f.vector.y) for f in fields), default=0.0) > 1e-3)
