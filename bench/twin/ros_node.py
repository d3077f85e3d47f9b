"""A ROS 2 node beside the twin: poses that a camera saw in; estimates, alarms and the coils' field out.

    swimtwin twin MODEL TWIN.toml --output DIR --listen 7000
    python3 ros_node.py --ros-args -p port:=7000 -r pose:=/camera/head

pose      geometry_msgs/PoseStamped, stamped at capture; position in m, rotation about z       subscribed
estimate  geometry_msgs/PoseWithCovarianceStamped, of the head                                 published
alarm     std_msgs/String, a line of the stream (docs/file-formats.md, "The twin's stream")    published
field     geometry_msgs/Vector3Stamped, T, a hundred times a second: with a goal, what is to play
"""
import json
import math
import socket
import threading

import rclpy
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped, Vector3Stamped
from rclpy.node import Node
from std_msgs.msg import String


class TwinNode(Node):
    def __init__(self):
        super().__init__("swimtwin")
        port = self.declare_parameter("port", 7000).value
        self.connection = socket.create_connection(("127.0.0.1", port))
        self.stream, self.samples = self.connection.makefile("w", newline="\n"), []
        self.estimate = self.create_publisher(PoseWithCovarianceStamped, "estimate", 10)
        self.alarm = self.create_publisher(String, "alarm", 10)
        self.field = self.create_publisher(Vector3Stamped, "field", 10)
        self.create_subscription(PoseStamped, "pose", self.see, 100)
        self.create_timer(0.01, self.play)
        threading.Thread(target=self.listen, daemon=True).start()

    def see(self, pose):
        p, q, stamp = pose.pose.position, pose.pose.orientation, pose.header.stamp
        frame = {"type": "frame", "time_s": stamp.sec + 1e-9 * stamp.nanosec, "x_m": p.x, "y_m": p.y,
                 "angle_rad": 2.0 * math.atan2(q.z, q.w)}
        print(json.dumps(frame), file=self.stream, flush=True)

    def listen(self):
        for line in self.connection.makefile("r"):
            answer = json.loads(line)
            if answer["type"] == "estimate":
                self.tell(answer)
            elif answer["type"] == "play":
                new = answer["samples"]  # from one decision ahead on; until then what was said before goes on
                self.samples = [s for s in self.samples if s[0] < new[0][0] - 1e-6] + new
            elif answer["type"] in ("alarm", "error"):
                self.alarm.publish(String(data=line.rstrip()))

    def tell(self, answer):
        message = PoseWithCovarianceStamped()
        message.header.stamp.sec, message.header.stamp.nanosec = divmod(round(1e9 * answer["time_s"]), 10**9)
        pose, sd = message.pose.pose, answer["sd"]
        pose.position.x, pose.position.y = answer["x_m"], answer["y_m"]
        pose.orientation.z, pose.orientation.w = math.sin(0.5 * answer["angle_rad"]), math.cos(0.5 * answer["angle_rad"])
        covariance = [0.0] * 36
        covariance[0], covariance[7], covariance[35] = sd["x_m"] ** 2, sd["y_m"] ** 2, sd["angle_rad"] ** 2
        message.pose.covariance = covariance
        self.estimate.publish(message)

    def play(self):
        now, samples = self.get_clock().now().nanoseconds * 1e-9, self.samples
        if not samples:
            return
        i = next((k for k, s in enumerate(samples) if s[0] > now), len(samples))
        a, b = samples[max(i - 1, 0)], samples[min(i, len(samples) - 1)]
        share = (now - a[0]) / (b[0] - a[0]) if b[0] > a[0] else 0.0
        message = Vector3Stamped()
        message.header.stamp = self.get_clock().now().to_msg()
        share = min(max(share, 0.0), 1.0)
        message.vector.x, message.vector.y = (a[k] + share * (b[k] - a[k]) for k in (1, 2))
        self.field.publish(message)


if __name__ == "__main__":
    rclpy.init()
    rclpy.spin(TwinNode())
