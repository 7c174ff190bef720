#!/bin/bash
# Hosts of a wall on one machine: each has its own network, name, home and processes' groups, an
# sshd and a systemd of the user. Needs root, network namespaces, and a cgroup2 to mount.
#   namespace_hosts.sh up FOLDER PREFIX NAME...
#   namespace_hosts.sh up_with_slurm FOLDER PREFIX NAME...    the first is the controller too
#   namespace_hosts.sh host FOLDER PREFIX NAME     (one of them, called by "up")
#   namespace_hosts.sh run FOLDER PREFIX NAME COMMAND...    on the network of one, in FOLDER
#   namespace_hosts.sh down FOLDER PREFIX
# In FOLDER: NAME/root, a host's home; NAME/log, what its systemd and sshd say. PREFIX begins the
# namespaces' names.
set -eu
self=$(readlink -f "$0") verb=$1 folder=$2 prefix=$3
shift 3

link() { # NAME NUMBER
  ip netns add "$prefix-$1"
  ip link add e0 netns "$prefix-$1" type veth peer name "p$2" netns "$prefix"
  ip -n "$prefix" link set "p$2" master br0 up
  ip -n "$prefix-$1" addr add "10.77.0.$2/24" dev e0
  ip -n "$prefix-$1" link set e0 up
  ip -n "$prefix-$1" link set lo up
  ip -n "$prefix-$1" route add 224.0.0.0/4 dev e0
}

keys() {
  mkdir -p "$folder/ssh" "$folder/bin"
  ssh-keygen -q -t ed25519 -N '' -f "$folder/ssh/host"
  ssh-keygen -q -t ed25519 -N '' -f "$folder/ssh/user"
  {
    printf 'Host *\n  Port 2222\n  User root\n  IdentityFile %s/ssh/user\n' "$folder"
    printf '  StrictHostKeyChecking no\n  UserKnownHostsFile /dev/null\n  LogLevel ERROR\n'
  } > "$folder/ssh/config"
  {
    printf 'Port 2222\nHostKey %s/ssh/host\nAuthorizedKeysFile %s/ssh/user.pub\n' \
      "$folder" "$folder"
    printf 'StrictModes no\nPasswordAuthentication no\nPermitRootLogin prohibit-password\n'
    printf 'UsePAM no\nPidFile none\nMaxStartups 64:30:128\nSetEnv XDG_RUNTIME_DIR=/run/user/0\n'
  } > "$folder/ssh/sshd_config"
  printf '#!/bin/sh\nexec /usr/bin/ssh -F %s/ssh/config "$@"\n' "$folder" > "$folder/bin/ssh"
  chmod +x "$folder/bin/ssh"
}

# What the clients of Slurm and its daemons read; a daemon's own files are in slurm/NAME.
slurm_files() {
  local slurm=$folder/slurm number=1 name
  mkdir -p "$slurm"
  mungekey --create --keyfile "$slurm/munge.key"
  printf 'CgroupPlugin=cgroup/v1\n' > "$slurm/cgroup.conf"
  {
    printf 'ClusterName=%s\nSlurmctldHost=%s\n' "$prefix" "$1"
    printf 'SlurmUser=root\nSlurmdUser=root\n'
    printf 'AuthType=auth/munge\nAuthInfo=socket=%s/munge.socket\n' "$slurm"
    printf 'StateSaveLocation=%s/state\nSlurmctldPidFile=%s/slurmctld.pid\n' "$slurm" "$slurm"
    printf 'SlurmdSpoolDir=%s/%%n\nSlurmdPidFile=%s/%%n/pid\n' "$slurm" "$slurm"
    printf 'ProctrackType=proctrack/pgid\nTaskPlugin=task/none\nMpiDefault=none\n'
    printf 'JobAcctGatherType=jobacct_gather/none\nReturnToService=2\nKillWait=5\n'
    printf 'SlurmdParameters=config_overrides\n'
    for name; do
      printf 'NodeName=%s NodeHostname=%s NodeAddr=10.77.0.%s CPUs=2\n' "$name" "$name" "$number"
      number=$((number + 1))
    done
    printf 'PartitionName=wall Nodes=ALL Default=YES\n'
  } > "$slurm/slurm.conf"
}

slurm_daemons() { # NAME
  local slurm=$folder/slurm
  mkdir -p "$slurm/$1" "$slurm/state"
  export SLURM_CONF=$slurm/slurm.conf
  if grep -q "^SlurmctldHost=$1$" "$SLURM_CONF"; then
    munged --foreground --force --key-file="$slurm/munge.key" --socket="$slurm/munge.socket" \
      --pid-file="$slurm/munged.pid" --log-file="$slurm/munged.log" \
      --seed-file="$slurm/munged.seed" &
    until [ -S "$slurm/munge.socket" ]; do sleep 0.05; done
    slurmctld -D -c &
  fi
  until [ -S "$slurm/munge.socket" ]; do sleep 0.05; done
  slurmd -D -N "$1" &
}

up_with_slurm() {
  command -v mungekey munged slurmctld slurmd sbatch > /dev/null || exit 77
  slurm_files "$@"
  up "$@"
  until [ "$(run "$1" sinfo -h -N -t idle -o %N | wc -l)" = $# ]; do sleep 0.2; done
}

up() {
  keys
  ip netns add "$prefix"
  ip -n "$prefix" link add br0 type bridge mcast_snooping 0
  ip -n "$prefix" link set br0 up
  local number=1 name
  echo '127.0.0.1 localhost' > "$folder/hosts"
  for name; do
    echo "10.77.0.$number $name" >> "$folder/hosts"
    link "$name" "$number"
    number=$((number + 1))
  done
  for name; do
    mkdir -p "$folder/$name/root"
    nsenter --net="/var/run/netns/$prefix-$name" unshare --uts --mount --cgroup \
      "$self" host "$folder" "$prefix" "$name" \
      > "$folder/$name/log" 2>&1 < /dev/null &
  done
  for name; do
    until [ -e "$folder/$name/root/ready" ] || [ -e "$folder/$name/root/failed" ]; do
      sleep 0.05
    done
    [ ! -e "$folder/$name/root/failed" ] || { cat "$folder/$name/log" >&2; exit 1; }
  done
}

host() {
  local name=$1
  trap 'touch "$folder/$name/root/failed"' EXIT
  hostname "$name"
  mount --bind "$folder/hosts" /etc/hosts
  mount -t cgroup2 none /sys/fs/cgroup
  mount -t tmpfs none /run
  [ ! -e /tmp/.X11-unix ] || mount -t tmpfs none /tmp/.X11-unix  # no screen of this machine's
  mount --bind "$folder/$name/root" /root
  unset XDG_CACHE_HOME
  export HOME=/root XDG_RUNTIME_DIR=/run/user/0 SYSTEMD_LOG_TARGET=console SYSTEMD_LOG_LEVEL=notice
  mkdir -p /run/systemd/system /run/sshd "$XDG_RUNTIME_DIR" "/sys/fs/cgroup/$prefix-$name"
  chmod 700 "$XDG_RUNTIME_DIR"
  echo $$ > "/sys/fs/cgroup/$prefix-$name/cgroup.procs"
  /usr/sbin/sshd -D -e -f "$folder/ssh/sshd_config" &
  [ ! -e "$folder/slurm" ] || slurm_daemons "$name"
  cd /root
  (
    until systemctl --user is-active --quiet basic.target 2> /dev/null; do sleep 0.05; done
    touch /root/ready
  ) &
  exec /lib/systemd/systemd --user --unit=basic.target
}

run() {
  local name=$1
  shift
  export SLURM_CONF="$folder/slurm/slurm.conf"
  cd "$folder"
  exec nsenter --net="/var/run/netns/$prefix-$name" unshare --mount sh -c \
    'mount --bind "$1/hosts" /etc/hosts; export PATH="$1/bin:$PATH"; shift; exec "$@"' \
    sh "$folder" "$@"
}

down() {
  local group
  mkdir -p "$folder/cgroup"
  mount -t cgroup2 none "$folder/cgroup"
  for group in "$folder/cgroup/$prefix"-*; do
    [ -d "$group" ] || continue
    echo 1 > "$group/cgroup.kill"
    until find "$group" -depth -type d -exec rmdir {} + 2> /dev/null; do sleep 0.05; done
  done
  umount "$folder/cgroup"
  ip netns list | sed -n "s/^\($prefix\(-[^ ]*\)\?\)\( .*\)\?$/\1/p" | xargs -rn1 ip netns del
}

"$verb" "$@"
