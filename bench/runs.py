"""Runs of the release tool for the benchmarks: one process on one core, with its summary, motion and CPU time."""
import csv
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
TOOL = pathlib.Path(os.environ.get("SWIMTWIN_TOOL", ROOT / "build" / "release" / "swimtwin"))
ENVIRONMENT = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1",
                   OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
# What datasets/models/reference-3d.h5 was trained on; reference-3d-paper as shipped is a tenth finer.
MESH_OF_SPATIAL_MODEL = {"numerics.mesh_size_m": 4e-4, "numerics.mesh_size_corner_m": 1.5e-4,
                         "numerics.mesh_size_far_m": 4e-3, "numerics.mesh_growth": 0.5}


def listening_port(twin):
    """Of `swimtwin twin --listen 0` with its standard error as a text pipe: what it says before, it says."""
    for line in twin.stderr:
        if found := re.search(r"127\.0\.0\.1:(\d+)", line):
            return found.group(1)
        print(line, end="", file=sys.stderr)
    sys.exit("the twin ended before it listened")


def run(scene, settings, n_ranks=1):
    """One run: summary.json, the rows of trajectory.csv, CPU seconds (user and system, start to exit, all ranks)."""
    if not TOOL.exists():
        sys.exit(f"{TOOL} is not there: run scripts/build release first, or name the tool in SWIMTWIN_TOOL")
    with tempfile.TemporaryDirectory() as folder:
        ranks = ["mpirun", "--oversubscribe", "-n", str(n_ranks)] if n_ranks > 1 else []
        command = [*ranks, str(TOOL), "simulate", str(scene), "--quiet", "--force", "--output", folder]
        for key, value in {"fluid.inertia": "none", **settings}.items():  # quasi-static unless asked for more
            command += ["--set", f"{key}={value}"]
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run(command, check=True, env=ENVIRONMENT, cwd=ROOT)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        summary = json.loads((pathlib.Path(folder) / "summary.json").read_text())
        with (pathlib.Path(folder) / "trajectory.csv").open() as file:
            trajectory = list(csv.DictReader(file))
    return summary, trajectory, (after.ru_utime - before.ru_utime) + (after.ru_stime - before.ru_stime)
