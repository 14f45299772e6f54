#!/usr/bin/env bash
# Finding: Debian 13's slurmctld ends at once when it is started by the name of its file.
#
# Guess: Debian installs slurmctld as /usr/sbin/slurmctld-wlm, with slurmctld a link that its alternatives make; whoever
# unpacks the package without its scripts, in a test or an image, runs the file by the name that it has.
# Seen (slurmctld 24.11.5-4+deb13u1): started as slurmctld-wlm it ends with "certmgr plugin only allowed on slurmctld and
# slurmd", which names a plugin that this configuration does not mention, not the cause. Called slurmctld the same file
# goes on, here to where it misses munged. So unpack, then link the names.
#
# Needs a Debian with apt, of any release; fetches Debian 13's packages and runs them with their own C library.
set -euo pipefail
version=24.11.5-4+deb13u1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Origin: Debian' 'Component: main' | head -n 1)
mkdir -p "$work"/{debs/partial,lists/partial,root,state,nothing}
: >"$work/status"
echo "deb [signed-by=/usr/share/keyrings/debian-archive-keyring.gpg] $mirror trixie main" >"$work/sources.list"
apt=(apt-get -qq -y --no-install-recommends -o Dir::Etc::sourcelist="$work/sources.list" -o Dir::Etc::sourceparts="$work/nothing"
    -o Dir::State::lists="$work/lists" -o Dir::State::status="$work/status" -o Dir::Cache::archives="$work/debs"
    -o Dir::Cache::pkgcache= -o Dir::Cache::srcpkgcache= -o Debug::NoLocking=1 -o APT::Sandbox::User=root)
"${apt[@]}" update >/dev/null
"${apt[@]}" --download-only install "slurmctld=$version" "slurm-wlm-basic-plugins=$version" >/dev/null
for deb in "$work"/debs/*.deb; do dpkg-deb -x "$deb" "$work/root"; done
lib=$work/root/usr/lib/x86_64-linux-gnu
cat >"$work/slurm.conf" <<CONF
ClusterName=found
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=$(id -u)
AuthType=auth/munge
AuthInfo=socket=$work/no-munged
CredType=cred/munge
MailProg=/bin/true
StateSaveLocation=$work/state
SlurmctldPidFile=$work/slurmctld.pid
PluginDir=$lib/slurm-wlm
NodeName=n1 NodeHostname=localhost NodeAddr=127.0.0.1
PartitionName=all Nodes=ALL
CONF
# start NAME: the file slurmctld-wlm, called by a name; what it says until it ends, for want of munged if for nothing else.
start() {
    SLURM_CONF=$work/slurm.conf timeout 20 "$lib/ld-linux-x86-64.so.2" --library-path "$lib:$lib/slurm-wlm" --argv0 "$1" \
        "$work/root/usr/sbin/slurmctld-wlm" -D -c 2>&1 | sed "s,$work,WORK,g" || true
}
for name in slurmctld-wlm slurmctld; do
    printf '%s\n' "== slurmctld $version called $name"
    start "$name" | tee "$work/$name.out"
done
grep -q 'certmgr plugin only allowed on slurmctld and slurmd' "$work/slurmctld-wlm.out" ||
    { echo "changed: it runs by the name of its file"; exit 1; }
grep -q 'failed to initialize auth plugin' "$work/slurmctld.out" ||
    { echo "changed: it does not run as slurmctld either"; exit 1; }
echo "as found: the same file ends by one name and goes on by the other"
