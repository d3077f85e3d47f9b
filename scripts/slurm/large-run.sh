#!/bin/bash
# One full-order run on several nodes.
#
#     sbatch scripts/slurm/large-run.sh SCENE OUTPUT [KEY=VALUE ...]
#
# The mesh is on every rank, matrices and vectors are shared out; what two ranks gain is in docs/benchmarks.md, "What
# space costs". Submitted again, it goes on from its checkpoint.
#SBATCH --job-name=swimtwin
#SBATCH --nodes=2
#SBATCH --ntasks-per-node=16
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu=2G
#SBATCH --time=12:00:00
set -eu
. "${SWIMTWIN_ROOT:-$SLURM_SUBMIT_DIR}/scripts/slurm/simulate.sh"

launcher=(srun --mpi=pmix)
simulate "$2" "$1" "${@:3}"
