# A client of the twin: sends what a camera sees, prints where the swimmer is and how stiff.
import json, socket, sys

port, camera = int(sys.argv[1]), sys.stdin  # swimtwin twin MODEL TWIN.toml --output DIR --listen PORT
connection = socket.create_connection(("127.0.0.1", port))
answers, stream = connection.makefile("r"), connection.makefile("w", newline="\n")
print(answers.readline(), end="")
for line in camera:  # {"type": "frame", "time_s": ..., "x_m": ..., "y_m": ..., "angle_rad": ...}
    print(line.rstrip(), file=stream, flush=True)
    while '"frame"' in line and (answer := json.loads(answers.readline()))["type"] not in ("estimate", "error"):
        print(answer["type"], answer.get("name", ""))
    if '"frame"' in line and answer["type"] == "estimate":
        print(answer["time_s"], answer["x_m"], answer["y_m"], answer["parameters"])
