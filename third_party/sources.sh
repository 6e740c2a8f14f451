# shellcheck shell=bash
# Sourced by the scripts that compile libraries for other systems.

# get_sources FOLDER PACKAGE...: unpacks the sources of Debian's packages, with Debian's patches, into the current folder.
# Changes nothing in the system, and needs no root: apt works with lists of its own, in FOLDER. What it says goes to
# FOLDER/log.
get_sources() {
  local apt=$1 place package version
  shift
  mkdir -p "$apt"/lists/partial "$apt"/cache/archives/partial "$apt"/parts
  for place in /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources; do
    [ ! -e "$place" ] || sed 's/^Types:.*/Types: deb-src/; s/^deb /deb-src /' "$place" >"$apt/parts/${place##*/}"
  done
  cat >"$apt/conf" <<CONF
APT::Sandbox::User "";
Dir::Etc::SourceList "/dev/null";
Dir::Etc::SourceParts "$apt/parts";
Dir::State "$apt";
Dir::State::status "/var/lib/dpkg/status";
Dir::Cache "$apt/cache";
Acquire::Retries "3";
Acquire::Languages "none";
CONF
  local -x APT_CONFIG=$apt/conf
  apt-get -q update >"$apt/log" 2>&1 || return 1
  for package in "$@"; do
    # The newest version whose files the servers have: lists may be newer than they are.
    for version in $(apt-cache showsrc "$package" | sed -n 's/^Version: //p' | sort -rV); do
      apt-get -q source "$package=$version" >>"$apt/log" 2>&1 && continue 2
    done
    return 1
  done
}
