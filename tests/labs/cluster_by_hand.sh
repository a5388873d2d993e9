#!/bin/sh
# cluster_by_hand.sh: judges a class in parts, with GNU parallel and as a Slurm job array on a cluster of
# this machine, and compares both with the class judged at once.
#
#   tests/labs/cluster_by_hand.sh [BUILD_FOLDER]
#
# Needs root and packages that tests/run does not install: apt-get install parallel slurm-wlm munge
# Slurm runs from a temporary folder on its own ports; no service or configuration is changed.

set -eu
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd -P)
check=$(readlink -f -- "${1:-$root/build}")/examples/check
solutions=$root/tests/labs/solutions/lab05_per_fragment
starter=$root/examples/labs/lab05_per_fragment
parts=4

for program in parallel sbatch slurmctld slurmd munged "$check"; do
    command -v "$program" >/dev/null || {
        echo "cluster_by_hand.sh: $program is missing" >&2
        exit 77
    }
done

folder=$(mktemp -d)
chmod 755 "$folder"
daemons=
finish() {
    # shellcheck disable=SC2086
    [ -z "$daemons" ] || kill $daemons 2>/dev/null || :
    wait
    rm -rf "$folder"
}
trap finish EXIT
cd "$folder"

for i in 0 1 2 3 4 5 6 7 8 9; do
    case $i in 0 | 3 | 6 | 9) from=$starter ;; *) from=$solutions ;; esac
    mkdir -p "class/student$i"
    cp "$from"/*.vert "$from"/*.frag "class/student$i"
done

# Without the column of times.
same() {
    for out in whole "$1"; do
        cut -d, -f1-12,14 "$out/class.csv" >"$out.csv"
    done
    cmp whole.csv "$1.csv" || {
        echo "cluster_by_hand.sh: $1 differs from the class judged at once" >&2
        exit 1
    }
    echo "$1: the same"
}

"$check" --class class --lab 5 -o whole

# GNU parallel.
mkdir parallel
# shellcheck disable=SC2046
parallel --will-cite -j 2 "$check" --class class --lab 5 --part "{}/$parts" --jobs 1 -o "parallel/{}" \
    ::: $(seq $parts)
"$check" --merge parallel/* -o by_parallel
same by_parallel

# Slurm, of one node.
mkdir state spool munge slurm
chmod 700 munge
dd if=/dev/urandom of=munge/key bs=1024 count=1 2>/dev/null
chmod 400 munge/key
munged --foreground --force --key-file=munge/key --socket="$folder/munge/socket" \
    --pid-file="$folder/munge/pid" --log-file="$folder/munge/log" --seed-file="$folder/munge/seed" \
    >munge.log 2>&1 &
daemons="$daemons $!"
host=$(hostname -s)
cat >slurm.conf <<CONF
ClusterName=one
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
ReturnToService=2
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldPort=26817
SlurmdPort=26818
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc)
PartitionName=all Nodes=$host Default=YES State=UP
CONF
export SLURM_CONF="$folder/slurm.conf"
slurmctld -D -c >slurmctld.log 2>&1 &
daemons="$daemons $!"
slurmd -D -c >slurmd.log 2>&1 &
daemons="$daemons $!"
for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
    sinfo -h -o %t 2>/dev/null | grep -q idle && break
    sleep 1
done
sinfo -h -o %t | grep -q idle || {
    tail -n 5 slurmctld.log slurmd.log >&2
    echo "cluster_by_hand.sh: Slurm's node does not come up" >&2
    exit 1
}

cat >job.sh <<JOB
#!/bin/sh
#SBATCH --array=1-$parts
#SBATCH --output=slurm/log-%a
exec "$check" --class class --lab 5 --part "\$SLURM_ARRAY_TASK_ID/$parts" --jobs 1 \\
    -o "slurm/part\$SLURM_ARRAY_TASK_ID"
JOB
sbatch --wait job.sh || {
    tail -n 3 slurm/log-* slurmd.log >&2
    exit 1
}
"$check" --merge slurm/part* -o by_slurm
same by_slurm
