#!/bin/bash
#SBATCH --job-name=heightlight
#SBATCH --array=1-16
#SBATCH --cpus-per-task=8
#SBATCH --mem=16G
#SBATCH --time=08:00:00
#SBATCH --requeue
# A task per shard of a dataset, in a folder that all nodes see; then one task more for the tables:
#   job=$(sbatch --parsable slurm_dataset.sh study.json study)
#   sbatch --dependency=afterany:"$job" --wrap='heightlight dataset study.json -o study --merge'
set -euo pipefail
share=$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT
exec heightlight dataset "$1" -o "$2" --shard "$share" --quiet \
  --threads "$SLURM_CPUS_PER_TASK" --memory $((SLURM_MEM_PER_NODE * 4 / 5))M
# Submitted once more, with the whole array, it does only what is missing.
