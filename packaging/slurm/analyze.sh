#!/bin/bash
# Reads the sessions of a study on several machines, every N-th session for each task of the array:
#
#     sbatch --array=1-16 --cpus-per-task=4 --mem=4G --time=00:30:00 analyze.sh shards sessions/overt_2019/*
#
# and joins them when all tasks are done (sbatch --dependency=afterok:JOB join.sh, or by hand):
#
#     overt analyze shards/shard_*_of_16 --out analysis
#
# A part is written whole or not at all; one that is there from an earlier attempt is written again.
#SBATCH --job-name=overt-analyze
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail
shards=${1:?usage: sbatch --array=1-N analyze.sh SHARDS SESSION... [OPTIONS OF overt analyze]}
shift
exec srun overt analyze "$@" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --out "$shards" --overwrite
