#!/bin/sh
# make_blender.sh ROOT [SUITE]: lay a Debian tree with its real Blender under ROOT (about a minute, 1.3 GB). SUITE is
# trixie (default), or sid: the newest Blender, on a Python for which the libraries come from Debian as well.
# Needs Debian and root. Nothing is mounted, so ROOT can be removed like any other folder.
set -eu
root=$1
suite=${2:-trixie}
packages="blender python3-numpy python3-requests python3-zstandard xvfb xauth imagemagick
libgl1-mesa-dri libegl1 libgl1 libglx-mesa0 fonts-dejavu-core"
[ "$suite" = trixie ] || packages="$packages python3-cattr python3-scipy python3-sklearn python3-pydyf"
export DEBIAN_FRONTEND=noninteractive LC_ALL=C

stamp="$suite $(echo $packages)"
[ "$(cat "$root/.ready" 2>/dev/null)" = "$stamp" ] && exit 0

if ! command -v debootstrap >/dev/null; then
    apt-get update -q
    apt-get install -y -q --no-install-recommends debootstrap
fi
# the mirror that this machine's own main packages come from
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Component: main' |
    grep -v security | head -n 1)

step() { printf '\n=== %s\n' "$*"; }

step "1 of 3: a bare Debian"
rm -rf --one-file-system "$root"
debootstrap --variant=minbase --include=ca-certificates "$suite" "$root" "$mirror"
printf '#!/bin/sh\nexit 101\n' >"$root/usr/sbin/policy-rc.d" # no service is to start in there
chmod +x "$root/usr/sbin/policy-rc.d"
cat >"$root/etc/apt/apt.conf.d/99tree" <<CONF
APT::Install-Recommends "false";
Acquire::Check-Valid-Until "false";
Acquire::Languages "none";
CONF
cat >"$root/etc/dpkg/dpkg.cfg.d/99tree" <<CONF
path-exclude=/usr/share/doc/*
path-exclude=/usr/share/man/*
path-exclude=/usr/share/locale/*
force-unsafe-io
CONF
step "2 of 3: what there is to install"
chroot "$root" apt-get update -q
step "3 of 3: Blender and a virtual screen"
# shellcheck disable=SC2086
chroot "$root" apt-get install -y -q $packages
chroot "$root" apt-get clean
echo "$stamp" >"$root/.ready"
