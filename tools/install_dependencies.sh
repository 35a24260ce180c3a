#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs, on Debian 12, what DEM4GRM needs. Does nothing, and asks for no rights, when everything is there.
#
#   tools/install_dependencies.sh build        to build and to run
#   tools/install_dependencies.sh test         the same, and all that test.sh uses
#   tools/install_dependencies.sh peers        the programs of others that DEM4GRM is compared with
#   tools/install_dependencies.sh octave       GNU Octave with what it draws by, for the test of examples/matlab
#   tools/install_dependencies.sh --list test  names the packages and stops
#
# Exit codes: 0 everything is installed, 64 wrong usage, 69 packages are missing and cannot be installed.
set -euo pipefail

build_packages=(
  g++ cmake ninja-build make pkg-config git ca-certificates
  libtomlplusplus-dev libcli11-dev libspdlog-dev libfmt-dev nlohmann-json3-dev
  libhdf5-dev zlib1g-dev libxxhash-dev libeigen3-dev libboost-dev
)
# The report page is made by node and npm. Whoever has them from elsewhere keeps those: Debian's npm does not go with another node.
if ! command -v node >/dev/null || ! command -v npm >/dev/null; then
  build_packages+=(nodejs npm)
fi
# clang-14, its OpenMP runtime and llvm-14 (which names source lines in reports) serve the thread sanitizer only,
# see docs/decisions/0003-thread-sanitizer.md. g++-aarch64 and qemu compile and run the engine for 64-bit Arm,
# see docs/decisions/0017-processor-targets.md. A cluster of two node daemons runs campaigns, see tests/cluster.
# chromium opens the report page, see web/test.
# Sphinx, MyST and a theme build the documentation site, see docs/decisions/0029-documentation-site.md.
# VTK reads what `dem4grm export` writes, see docs/decisions/0027-vtk-export.md.
# The Python package needs python3-dev, pybind11 and pandas; pip, setuptools and wheel make it installable, see docs/how-to/python.md.
# The example notebooks are executed in a kernel as Jupyter has it, 25 MB with what it needs; Jupyter itself is left to the reader.
# The calibration desk fits with scikit-learn, which brings SciPy, see docs/decisions/0030-calibration-desk.md.
test_packages=(
  "${build_packages[@]}"
  libgtest-dev librapidcheck-dev
  clang-14 libclang-rt-14-dev libomp-14-dev llvm-14 clang-format-14 clang-tidy-14
  python3 python3-numpy python3-h5py python3-matplotlib python3-vtk9
  python3-dev pybind11-dev python3-pandas python3-sklearn python3-pytest python3-pip python3-setuptools python3-wheel
  python3-nbclient python3-ipykernel
  g++-aarch64-linux-gnu qemu-user
  slurm-wlm munge
  chromium
  python3-sphinx python3-myst-parser furo fonts-texgyre-math
)

# See docs/verification/independent-codes.md and bench/peers; no other check uses them.
peer_packages=(lammps liggghts yade mpi-default-bin python3 python3-numpy python3-matplotlib)

# 310 MB, so only when asked for. Without a display Octave draws by gnuplot, prints through Ghostscript and needs these letters.
octave_packages=(octave gnuplot-nox ghostscript fonts-freefont-otf hdf5-tools python3 python3-matplotlib)

usage() {
  echo "usage: tools/install_dependencies.sh [--list] build|test|peers|octave" >&2
  exit 64
}

is_installed() { [[ "$(dpkg-query -W -f='${db:Status-Status}\n' "$1" 2>/dev/null | sort -u)" == installed ]]; }

# Debian's ParaView has VTK's Python modules of its own, and each of the two packages would remove the other.
is_served() { is_installed "$1" || { [[ "$1" == python3-vtk9 ]] && is_installed python3-paraview; }; }

has_candidate() {
  local candidate
  candidate="$(LC_ALL=C apt-cache policy "$1" 2>/dev/null | awk '$1 == "Candidate:" { print $2; exit }')"
  [[ -n "$candidate" && "$candidate" != "(none)" ]]
}

list_only=no
if [[ "${1:-}" == --list ]]; then
  list_only=yes
  shift
fi
[[ $# -eq 1 ]] || usage
case "$1" in
  build) packages=("${build_packages[@]}") ;;
  test) packages=("${test_packages[@]}") ;;
  peers) packages=("${peer_packages[@]}") ;;
  octave) packages=("${octave_packages[@]}") ;;
  *) usage ;;
esac
if [[ $list_only == yes ]]; then
  printf '%s\n' "${packages[@]}"
  exit 0
fi

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "install_dependencies: this system has no apt. Install the counterparts of these Debian 12 packages by hand:" >&2
  echo "  ${packages[*]}" >&2
  exit 69
fi

missing=()
for package in "${packages[@]}"; do
  is_served "$package" || missing+=("$package")
done
if [[ ${#missing[@]} -eq 0 ]]; then
  echo "install_dependencies: all ${#packages[@]} packages of group '$1' are installed"
  exit 0
fi

# An administrator's rights: root has them, others through sudo. Without a terminal sudo must not wait for a password.
as_root=()
if [[ "$(id -u)" -ne 0 ]]; then
  if command -v sudo >/dev/null && { [[ -t 0 ]] || sudo -n true 2>/dev/null; }; then
    as_root=(sudo)
  else
    echo "install_dependencies: ${#missing[@]} packages are missing, and you are neither root nor able to use sudo." >&2
    echo "Ask an administrator to run:" >&2
    echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 69
  fi
fi
apt() { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get "$@"; }
install_missing() { apt install -y -q --no-install-recommends "${missing[@]}"; }

echo "install_dependencies: installing ${missing[*]}"
lists_are_fresh=no
for package in "${missing[@]}"; do
  if ! has_candidate "$package"; then
    apt update -q
    lists_are_fresh=yes
    break
  fi
done
# Old package lists name versions that are gone from the archive: then one update and one more try.
if ! install_missing; then
  if [[ $lists_are_fresh == no ]] && apt update -q && install_missing; then
    exit 0
  fi
  echo "install_dependencies: apt-get could not install all of: ${missing[*]}" >&2
  echo "The text above says why; the packages are those of Debian 12." >&2
  exit 69
fi
