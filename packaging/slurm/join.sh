#!/bin/bash
# Joins the parts that the tasks of analyze.sh read:
#
#     sbatch --dependency=afterok:JOB join.sh shards analysis
#
# Where a task failed and was queued again (scontrol requeue), Slurm holds this job back as DependencyNeverSatisfied, also
# when the task has ended well since; then it is released by hand: scontrol update JobId=… Dependency=
#
#SBATCH --job-name=overt-join
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail
shards=${1:?usage: sbatch join.sh SHARDS ANALYSIS [OPTIONS OF overt analyze]}
analysis=${2:?usage: sbatch join.sh SHARDS ANALYSIS [OPTIONS OF overt analyze]}
shift 2
exec srun overt analyze "$shards"/shard_*_of_* --out "$analysis" --overwrite "$@"
