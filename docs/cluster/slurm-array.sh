#!/bin/sh
# A study in eight parts, each a task of an array: sbatch slurm-array.sh
# Afterwards, once: sawflutter study merge runs --out result
#SBATCH --job-name=saws
#SBATCH --array=1-8
#SBATCH --cpus-per-task=4
#SBATCH --requeue
#SBATCH --output=saws-%a.txt
export RAYON_NUM_THREADS="$SLURM_CPUS_PER_TASK"
exec sawflutter study saw.json study.json --out runs --shard "$SLURM_ARRAY_TASK_ID/8"
