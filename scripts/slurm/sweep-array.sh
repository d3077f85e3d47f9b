#!/bin/bash
# Full-order runs over frequencies as a job array: one run per task, one core each.
#
#     sbatch scripts/slurm/sweep-array.sh SCENE OUTPUT [KEY=VALUE ...]
#
# Results are in OUTPUT/f-FREQUENCY; a task that was cut off goes on where it was when the array is submitted again.
#SBATCH --job-name=swimtwin-sweep
#SBATCH --array=0-7
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --mem=2G
#SBATCH --time=02:00:00
set -eu
. "${SWIMTWIN_ROOT:-$SLURM_SUBMIT_DIR}/scripts/slurm/simulate.sh"

frequencies_Hz=(0.1 0.2 0.4 0.6 0.8 1.1 1.7 3.0)
frequency=${frequencies_Hz[$SLURM_ARRAY_TASK_ID]}
folder=$2/f-$frequency
if grep -qs '"status": "completed"' "$folder/summary.json"; then exit 0; fi
simulate "$folder" "$1" field.frequency_Hz="$frequency" "${@:3}"
