#!/bin/bash
# A dataset by several processes of one machine, each with its share of the runs, then the tables:
#   parallel_dataset.sh study.json study 4 3G     # 4 processes, 3 GiB for each
# With `parallel --sshloginfile HOSTS --workdir .`, of several machines that share the folder.
set -euo pipefail
manifest=${1:?no manifest}
folder=${2:?no folder}
jobs=${3:?no number of processes}
memory=${4:?no memory for each}
threads=$(($(nproc) / jobs))
((threads > 0)) || threads=1
# Where a share fails, --merge says which runs are missing. Begun once more, only those are done.
seq "$jobs" | parallel --quote --jobs "$jobs" heightlight dataset "$manifest" -o "$folder" \
  --shard "{}/$jobs" --threads "$threads" --memory "$memory" --quiet || true
exec heightlight dataset "$manifest" -o "$folder" --merge
