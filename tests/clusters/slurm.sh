#!/usr/bin/env bash
# An array job of Slurm computes a study; the process of one shard is killed on the way: slurm.sh CACHE SCRIPT STUDY OUT
#
# SCRIPT is the job as a user submits it. Slurm runs on the loopback of a network namespace of its own; its processes end with the
# process namespace. What is not installed is unpacked from the distribution's packages into CACHE. The parts that were there at the
# time of the kill are listed in OUT.kept. Ends with 77 where Slurm cannot be had.
set -euo pipefail

skip() {
    echo "not to be had here: Slurm, $1; skipped"
    exit 77
}

# Folders of unpacked packages, in front of those of the system.
use() {
    local folder
    for folder in "$1"/usr/lib/*/; do
        export LD_LIBRARY_PATH=${folder%/}:${folder}slurm-wlm${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
    done
    export PATH=$1/usr/sbin:$1/usr/bin:$PATH
}

complete() {
    local name
    for name in slurmctld slurmd sbatch scontrol squeue sinfo munged ip; do
        command -v "$name" >/dev/null || return 1
    done
}

# The packages that lack here, for that this is not to change what is installed.
unpack() {
    local packages
    packages=$(apt-get install -s --no-install-recommends slurmctld slurmd slurm-client munge iproute2 2>/dev/null |
        awk '$1 == "Inst" { print $2 }') && test -n "$packages" || return 1
    rm -rf "$1" "$1.debs"
    mkdir -p "$1" "$1.debs"
    # shellcheck disable=SC2086 # a list of names
    (cd "$1.debs" && timeout 300 apt-get -q -o APT::Sandbox::User=root download $packages) >"$1.log" 2>&1 || return 1
    for package in "$1.debs"/*.deb; do dpkg -x "$package" "$1"; done
    rm -rf "$1.debs"
    # As Debian's alternatives name them.
    for package in "$1"/usr/sbin/slurm*-wlm; do ln -sf "$(basename "$package")" "${package%-wlm}"; done
}

if [ "${1:-}" != --inside ]; then
    cache=$1/slurm
    # Killed with this process, and its processes with it.
    namespace=(setpriv --pdeathsig KILL unshare --fork --pid --mount-proc --net --kill-child)
    test "$(id -u)" = 0 || skip "which needs root for a network namespace"
    "${namespace[@]}" true 2>/dev/null || skip "no process and network namespaces by setpriv and unshare"
    command -v pgrep >/dev/null || skip "pgrep is missing"
    if ! complete; then
        use "$cache"
        if ! complete; then
            command -v apt-get >/dev/null || skip "it is not installed, and there is no apt-get"
            mkdir -p "$cache"
            unpack "$cache" || { timeout 300 apt-get -qq update >/dev/null 2>&1; unpack "$cache"; } || skip "its packages could not be fetched"
            use "$cache"
            complete || skip "its packages lack a program"
        fi
    fi
    # A short path: a socket's has at most 107 characters.
    run=$(mktemp -d /tmp/slurm-XXXXXX)
    child=
    # With the process that made it, the namespace ends and all that is in it.
    clean() {
        test -z "$child" || { kill -KILL "$child" && wait "$child"; } 2>/dev/null || true
        # A daemon may write once more while it ends.
        rm -rf "$run" || { sleep 1; rm -rf "$run"; }
    }
    trap clean EXIT
    trap 'exit 143' HUP INT TERM
    "${namespace[@]}" "$BASH" "$0" --inside "$run" "$cache" "${@:2}" &
    child=$!
    code=0
    wait "$child" || code=$?
    child=
    exit "$code"
fi

run=$2 cache=$3 script=$4 study=$5 out=$6
begun=$SECONDS

fail() {
    echo "Slurm: $1" >&2
    for log in "$run"/*.log; do
        echo "-- ${log##*/}" >&2
        tail -15 "$log" >&2
    done
    exit 1
}

# within SECONDS COMMAND …: whether the command succeeds within that time.
within() {
    local last=$((SECONDS + $1))
    until "${@:2}"; do
        test "$SECONDS" -lt "$last" || return 1
        sleep 0.2
    done
}

ip link set lo up
# Names are looked up by the kinds of addresses that there are, and those of loopback do not count.
ip address add 192.0.2.1/32 dev lo
host=$(uname -n)
host=${host%%.*}
plugins=()
for folder in "$cache"/usr/lib/*/slurm-wlm /usr/lib/*/slurm-wlm; do test ! -d "$folder" || plugins+=("$folder"); done

head -c 1024 /dev/urandom >"$run/key"
chmod 400 "$run/key"
chmod 755 "$run"
mkdir "$run/state" "$run/spool"
# cred_expire: for so long a task waits that is requeued, 120 s by default.
cat >"$run/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
AuthInfo=socket=$run/munge,cred_expire=5
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$run/state
SlurmdSpoolDir=$run/spool
SlurmctldPidFile=$run/slurmctld.pid
SlurmdPidFile=$run/slurmd.pid
SlurmctldLogFile=$run/slurmctld.log
SlurmdLogFile=$run/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=batch_sched_delay=0,sched_interval=1
SlurmdParameters=config_overrides
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
test "${#plugins[@]}" = 0 || (IFS=:; echo "PluginDir=${plugins[*]}") >>"$run/slurm.conf"
export SLURM_CONF=$run/slurm.conf

munged --force --key-file="$run/key" --socket="$run/munge" --pid-file="$run/munge.pid" --log-file="$run/munge.log" \
    --seed-file="$run/munge.seed" 2>"$run/munged.log" || fail "munged does not start"
slurmctld -D >"$run/slurmctld.out.log" 2>&1 &
stepd=$(dirname "$(command -v slurmd)")/slurmstepd
slurmd -D -N "$host" -d "$stepd" >"$run/slurmd.out.log" 2>&1 &
idle() { sinfo -h -o %T 2>/dev/null | grep -q idle; }
within 30 idle || fail "the node is not idle after 30 s: $(sinfo -h -o '%T %E' 2>&1)"
echo "$(sinfo --version), node idle after $((SECONDS - begun)) s"

job=$(sbatch --parsable --output="$run/task-%a.log" "$script" "$study" "$out") || fail "sbatch refuses the job"
parts() { test "$(find "$out" -name 'part-*.parquet' 2>/dev/null | wc -l)" -ge "$1"; }
finished() { test -z "$(squeue -h 2>&1)"; }
begun_or_failed() { parts 4 || finished; }
within 60 begun_or_failed && parts 4 || fail "no four parts within 60 s, or before the end of the job: $(squeue -h 2>&1)"
victim=$(pgrep -o -f -- '--shard auto') || fail "no process of a shard is running"
kill -KILL "$victim"
(cd "$out" && stat -c '%i %Y %n' part-*.parquet) >"$out.kept"
echo "process of a shard killed after $((SECONDS - begun)) s, $(wc -l <"$out.kept") parts are there"

within 240 finished || fail "the job has not ended: $(squeue -h 2>&1)"
tasks=$(scontrol show job -o "$job")
states=$(grep -o 'JobState=[A-Z_]*' <<<"$tasks" | sort | uniq -c | xargs)
restarts=$(grep -o ' Restarts=[0-9]*' <<<"$tasks" | sort | uniq -c | xargs)
echo "job ended after $((SECONDS - begun)) s: $states; $restarts"
test "$states" = "4 JobState=COMPLETED" || fail "a task has not completed"
test "$restarts" = "3 Restarts=0 1 Restarts=1" || fail "not just one task was requeued"
