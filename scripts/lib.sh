# shellcheck shell=bash
# What the scripts that build share: packages, configuration, build. To be sourced from the repository's top folder.

packages=(
  g++ cmake ninja-build pkg-config
  libsuitesparse-dev libopenblas-dev liblapacke-dev libnanoflann-dev libtbb-dev
  libcgal-dev libagg-dev
  libtomlplusplus-dev libcli11-dev libfmt-dev nlohmann-json3-dev zlib1g-dev
  libpugixml-dev libpng-dev libboost-dev
  libjs-chart.js libjs-three
  libgtest-dev libbenchmark-dev
)
# For export to STEP and 3MF; what the tests read exported files and JSON with; what they open pages with; a locale of theirs; what
# they run the scripts of the pages with; what they check the style of the sources with.
export_packages=(libocct-data-exchange-dev lib3mf-dev)
test_packages=(
  python3 python3-ezdxf python3-jsonschema python3-pil admesh librsvg2-bin
  chromium chromium-driver firefox-esr python3-selenium
  locales
  nodejs
  clang-format shellcheck universal-ctags
)
# What makes the site of the documents: its pages, their formulas, the references of the headers and of the Python module. The tests make it too.
site_packages=(python3-numpy python3-sphinx python3-myst-parser furo katex fonts-katex doxygen)
test_packages+=("${site_packages[@]}")
# For the Python module, and what its tests need besides.
python_packages=(python3-dev python3-numpy pybind11-dev)
test_packages+=(
  "${python_packages[@]}" python3-scipy python3-matplotlib python3-distributed mypy
  python3-pip python3-venv python3-setuptools python3-wheel
)
build_folder=build/release

fail() {
  printf '%s\n' "$@" >&2
  exit 1
}

is_installed() {
  [[ $(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null) == installed ]]
}

as_root() {
  if ((EUID == 0)); then
    "$@"
  else
    sudo "$@"
  fi
}

# Installs what dpkg does not know as installed, and says beforehand how much that is, as apt does; asks nothing, and
# touches nothing when all is there.
install_packages() {
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    fail "This system has no apt-get. Install what these packages of Debian 12 hold:" \
      "  ${packages[*]}" \
      "and build with: cmake --preset release && cmake --build --preset release"
  fi
  local missing=() package
  for package in "${packages[@]}"; do
    is_installed "$package" || missing+=("$package")
  done
  ((${#missing[@]})) || return 0
  ((EUID == 0)) || command -v sudo >/dev/null ||
    fail "Packages are missing, and only root may install them. Run as root:" \
      "  apt-get update && apt-get install --no-install-recommends ${missing[*]}"
  echo "Installing ${missing[*]}"
  as_root apt-get --quiet update ||
    fail "apt-get could not read the package lists: is there a network?"
  as_root env DEBIAN_FRONTEND=noninteractive apt-get --quiet --yes --no-install-recommends install \
    "${missing[@]}" ||
    fail "apt-get could not install the packages. Debian 12 (bookworm) has all of them."
}

# Configures, which finds libraries that were installed since, and builds the targets in Release. What is up to date is
# not built again. `configuration`: options for cmake.
configuration=()
build() {
  cmake --preset release "${configuration[@]}"
  cmake --build --preset release --target "$@"
}
