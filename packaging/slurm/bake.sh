#!/bin/bash
# Renders the stimuli of a protocol on several machines, one part of the frames for each task of the array:
#
#     OVERT_CACHE=/shared/cache sbatch --array=1-16 --cpus-per-task=16 --time=04:00:00 bake.sh protocol.toml --quality standard
#
# The cache has to be a folder that all machines share. A frame is written whole or not at all, so a task that was killed or
# put back into the queue goes on with the frame that it was at.
#SBATCH --job-name=overt-bake
#SBATCH --requeue
#SBATCH --open-mode=append
set -euo pipefail
: "${OVERT_CACHE:?set OVERT_CACHE to a folder that all machines share}"
protocol=${1:?usage: sbatch --array=1-N bake.sh PROTOCOL [OPTIONS OF overt bake]}
shift
# The array has to begin with 1: a task renders part I of N.
exec srun overt bake "$protocol" --context osmesa "$@" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT"
