# shellcheck shell=bash
# Sourced by the jobs beside it.

root=${SWIMTWIN_ROOT:-$SLURM_SUBMIT_DIR}
# shellcheck source=/dev/null
. "$root/scripts/environment.sh"

# simulate FOLDER SCENE [KEY=VALUE ...]: goes on from the checkpoint in FOLDER if there is one; words of `launcher` go
# before the tool.
launcher=()
simulate() {
  local folder=$1 words=(simulate "$2") entry
  for entry in "${@:3}"; do words+=(--set "$entry"); done
  if [ -e "$folder/checkpoint.h5" ]; then words+=(--resume); fi
  "${launcher[@]}" "$root/build/release/swimtwin" "${words[@]}" --output "$folder" --quiet
}
