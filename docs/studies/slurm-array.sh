#!/bin/bash
#SBATCH --array=0-3            # four shards
#SBATCH --cpus-per-task=1
#SBATCH --time=01:00:00
#SBATCH --requeue              # Slurm requeues a task whose node fails
#SBATCH --open-mode=append     # the log of a requeued task is kept

# sbatch slurm-array.sh STUDY DIR
stickslip study run "$1" --out "$2" --threads "${SLURM_CPUS_PER_TASK:-1}" --shard auto
code=$?

# A task whose process was killed by SIGKILL is requeued up to three times.
if [ "$code" -eq 137 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 3 ]; then
    scontrol requeue "${SLURM_ARRAY_JOB_ID}_${SLURM_ARRAY_TASK_ID}"
fi
exit "$code"
