#!/bin/sh
# A cluster of Dask inside an allocation: a scheduler on its first node, a worker process for every
# core of all nodes, and the study on it: sbatch slurm-dask.sh
# Scheduler and workers end with this script.
#SBATCH --job-name=saws
#SBATCH --nodes=4
#SBATCH --ntasks-per-node=1
#SBATCH --cpus-per-task=32
file=$PWD/scheduler-$SLURM_JOB_ID.json
dask scheduler --scheduler-file "$file" &
while [ ! -s "$file" ]; do sleep 1; done
srun dask worker --scheduler-file "$file" --nworkers "$SLURM_CPUS_PER_TASK" --nthreads 1 &
address=$(python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["address"])' "$file")
sawflutter study saw.json study.json --out runs --scheduler "$address"
