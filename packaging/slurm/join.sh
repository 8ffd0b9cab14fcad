#!/bin/bash
# Joins the parts that the tasks of analyze.sh read:
#
#     sbatch --dependency=afterok:JOB join.sh shards analysis
#
#SBATCH --job-name=overt-join
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail
shards=${1:?usage: sbatch join.sh SHARDS ANALYSIS [OPTIONS OF overt analyze]}
analysis=${2:?usage: sbatch join.sh SHARDS ANALYSIS [OPTIONS OF overt analyze]}
shift 2
exec srun overt analyze "$shards"/shard_*_of_* --out "$analysis" --overwrite "$@"
