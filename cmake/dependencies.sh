# Sourced by the scripts: installs what is missing, from Debian alone.
packages=(build-essential ca-certificates cmake file git ninja-build
  coinor-libclp-dev libassimp-dev libceres-dev libcli11-dev libeigen3-dev libembree-dev libfmt-dev libglfw3-dev libmujoco-dev libnanoflann-dev
  liboctomap-dev libopencv-core-dev libopencv-dnn-dev libopencv-features2d-dev libopencv-imgcodecs-dev libopencv-imgproc-dev libopencv-videoio-dev libopencv-dev
  libosmesa6-dev libpng-dev libspdlog-dev libyaml-cpp-dev libzstd-dev nlohmann-json3-dev zlib1g-dev
  libbenchmark-dev libgmock-dev libgtest-dev librapidcheck-dev
  libgl1-mesa-dri libx11-dev xvfb
  pybind11-dev python3-dev python3-jsonschema python3-matplotlib python3-numpy python3-pip python3-setuptools python3-venv
  python3-yaml zstd)

install_dependencies() {
  local missing=() package
  for package in "${packages[@]}"; do
    dpkg-query -W -f='${db:Status-Abbrev}' "$package" 2>/dev/null | grep -q '^ii' || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "run as root, or install sudo; missing: ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
  fi
  echo "installing ${#missing[@]} packages: ${missing[*]}" >&2
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# build PRESET [--target NAME...]: configures once, then builds what changed; what ccache, where it is
# installed, has compiled in any checkout is not compiled again.
build() {
  local preset=$1
  shift
  if command -v ccache >/dev/null; then
    export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache
    export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1 CCACHE_SLOPPINESS=pch_defines,time_macros
  fi
  [ -f "build/$preset/build.ninja" ] || cmake --preset "$preset" >/dev/null
  cmake --build --preset "$preset" "$@"
}

# ARGUMENTS...: asked for help, a script that has just changed its folder prints the comment at its head.
help_if_asked() {
  case "${1:-}" in
    -h | --help) (cd "$OLDPWD" && sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$0") && exit ;;
  esac
}
