# Shared by run and test, to be sourced by bash: installs the packages that are missing, configures,
# builds. What it says goes to the error stream; the output stream belongs to the program.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '%s\n' "$*" >&2; }

die() {
  say "$*"
  exit 1
}

# packages_of run|test|full: one name a line.
packages_of() {
  local tiers=run
  case $1 in
    test) tiers="run test" ;;
    full) tiers="run test full" ;;
  esac
  awk -v tiers="$tiers" '
    BEGIN { count = split(tiers, list, " "); for (i = 1; i <= count; ++i) wanted[list[i]] = 1 }
    /^[^#]/ && ($2 in wanted) { print $1 }' "$root/tools/packages.txt"
}

# missing_packages run|test|full: those that dpkg does not have; one call of dpkg for all.
missing_packages() {
  local wanted present
  mapfile -t wanted < <(packages_of "$1")
  present=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "${wanted[@]}" 2>/dev/null |
    sed -n 's/^installed //p')
  comm -23 <(printf '%s\n' "${wanted[@]}" | sort -u) <(printf '%s\n' "$present" | sort -u)
}

# need_packages run|test|full: installs what is missing, or says how to.
need_packages() {
  local missing as_root=()
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    say "This is no Debian: the packages in tools/packages.txt are taken to be there."
    return
  fi
  mapfile -t missing < <(missing_packages "$1")
  [[ ${#missing[@]} -eq 0 ]] && return
  say "Missing Debian packages: ${missing[*]}"
  if [[ $(id -u) -ne 0 ]]; then
    command -v sudo >/dev/null ||
      die "Only root can install them, and there is no sudo. As root:" \
        "apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo)
  fi
  say "Installing them (log: build/apt.log) ..."
  mkdir -p "$root/build"
  install_packages "${missing[@]}" || {
    tail -n 20 "$root/build/apt.log" >&2
    die "apt-get failed; its log is build/apt.log."
  }
}

# install_packages NAME...: with as_root of the caller in front of apt-get.
install_packages() {
  local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q)
  "${apt[@]}" update >"$root/build/apt.log" 2>&1 ||
    say "apt-get update failed; trying with the lists that are here."
  "${apt[@]}" install -y --no-install-recommends "$@" >>"$root/build/apt.log" 2>&1
}

# need_kernel PACKAGE FOLDER: a kernel of Debian's, unpacked in build/FOLDER and never installed.
need_kernel() {
  local folder=$root/build/$2 log=$root/build/$2.log package
  compgen -G "$folder/boot/vmlinuz-*" >/dev/null && return
  package=$(apt-cache depends "$1" 2>/dev/null |
    sed -n 's/^ *Depends: \(linux-image-[0-9].*\)/\1/p' | head -n 1)
  [[ -n $package ]] || die "apt knows no package $1; as root: apt-get update"
  say "Fetching $package and unpacking it to build/$2 ..."
  rm -rf "$folder" "$folder.new" && mkdir -p "$folder.new"
  (cd "$folder.new" && apt-get -q download "$package" && dpkg-deb -x ./*.deb . &&
    rm ./*.deb && mv "$folder.new" "$folder") >"$log" 2>&1 && return
  cat "$log" >&2
  die "$package cannot be had. If it was not found, as root: apt-get update"
}

# jobs: one for each processor, but at most one for every 1.5 GiB of memory that is free.
jobs() {
  local by_memory
  by_memory=$(awk '/MemAvailable/ { print int($2 / 1572864) }' /proc/meminfo)
  local count
  count=$(nproc)
  [[ $by_memory -lt $count ]] && count=$by_memory
  echo $((count > 1 ? count : 1))
}

# configure PRESET [CMAKE-ARGUMENT...]: silent unless it fails. Sources are compiled several at a
# time, which takes half the time; CONTRIBUTING.md says what else it means.
configure() {
  local preset=$1 log="$root/build/$1/configure.log"
  shift
  mkdir -p "$(dirname "$log")"
  (cd "$root" && cmake --preset "$preset" -DCMAKE_UNITY_BUILD=ON \
    -DCMAKE_UNITY_BUILD_BATCH_SIZE=12 "$@") >"$log" 2>&1 && return
  cat "$log" >&2
  die "The build of preset $preset could not be configured."
}

# build PRESET TARGET...: says nothing when there is nothing to do; a counter on a terminal, one
# line elsewhere.
build() {
  local preset=$1 log="$root/build/$1/build.log" line announced=
  shift
  NINJA_STATUS='[%f/%t] ' cmake --build "$root/build/$preset" --target "$@" \
    --parallel "$(jobs)" 2>&1 |
    tee "$log" |
    while IFS= read -r line; do
      [[ $line =~ ^\[([1-9][0-9]*)/([0-9]+)\]\  ]] || continue
      if [[ -t 2 ]]; then
        printf '\r\033[KBuilding %s: %d of %d' "$preset" "${BASH_REMATCH[@]:1:2}" >&2
      elif [[ -z $announced ]]; then
        say "Building $preset: ${BASH_REMATCH[2]} steps (log: build/$preset/build.log) ..."
      fi
      announced=yes
    done
  local status=${PIPESTATUS[0]}
  [[ -t 2 ]] && printf '\r\033[K' >&2
  [[ $status -eq 0 ]] && return
  grep -v -E '^\[[0-9]+/[0-9]+\] ' "$log" >&2
  die "The build failed; its log is build/$preset/build.log."
}
