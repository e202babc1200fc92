#!/bin/sh
# Works on the designs of a plan until none is left: sbatch --array=1-8 designs.sh FOLDER
#SBATCH --cpus-per-task=1
#SBATCH --time=4:00:00
#SBATCH --signal=B:TERM@120
#SBATCH --requeue
#SBATCH --open-mode=append
set -u

wheelwright designs "$1" --threads "${SLURM_CPUS_PER_TASK:-1}" &
program=$!
trap 'kill -TERM "$program"' TERM
wait "$program"
code=$?
if kill -0 "$program" 2> /dev/null; then # wait ended by the signal: the program is saving
  wait "$program"
  code=$?
fi
job=$SLURM_JOB_ID # of an array's last task: the same as that of the whole array
[ -z "${SLURM_ARRAY_TASK_ID:-}" ] || job=${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID
[ "$code" -ne 143 ] || scontrol requeue "$job" # the job's time ended; it continues later
exit "$code"
