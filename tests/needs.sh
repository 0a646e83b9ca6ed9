# What the checks need: each function installs its tools where it may, and otherwise names the command that does and fails. With CI=true
# it ends the checks. Read by check.sh.

# missing WHAT COMMAND
missing() {
  printf 'missing: %s; to install it: %s\n' "$1" "$2" >&2
  [ "${CI:-}" != true ] || exit 1
  return 1
}

install_packages() { apt-get update -q && apt-get install -y -q --no-install-recommends "$@"; } >&2

# apt_needs PROGRAM PACKAGE ...
apt_needs() {
  command -v "$1" >/dev/null || install_packages "${@:2}" || missing "$1" "apt-get install -y --no-install-recommends ${*:2}"
}

has_target() { rustup target list --installed 2>/dev/null | grep -qx "$1"; }
target_needs() { has_target "$1" || rustup target add "$1" || missing "target $1" "rustup target add $1"; }

# cargo_needs PROGRAM: from the crate of this name, not optimised, which would take minutes.
cargo_needs() {
  command -v "$1" >/dev/null || env -u CARGO_TARGET_DIR cargo install "$1" --locked --debug || missing "$1" "cargo install $1 --locked"
}

# Version 10 is the first that has all boards. Debian 12 has it in its backports: on the mirror from which the machine takes its packages.
has_qemu() { [ "$("$1" --version 2>/dev/null | sed -n '1s/.* version \([0-9]*\)\..*/\1/p')" -ge 10 ] 2>/dev/null; }
add_backports() {
  local mirror
  mirror=$(apt-get indextargets --format '$(RELEASE) $(COMPONENT) $(REPO_URI)' 'Created-By: Packages' |
    sed -n 's/^bookworm main //p' | head -n 1)
  printf 'deb %s bookworm-backports main\n' "${mirror:?}" >/etc/apt/sources.list.d/bookworm-backports.list
}
# qemu_needs PROGRAM PACKAGE
qemu_needs() {
  local suite=
  has_qemu "$1" && return
  if grep -qs '^VERSION_CODENAME=bookworm$' /etc/os-release; then
    suite='-t bookworm-backports '
    apt-cache policy | grep -q bookworm-backports || { apt-get update -q >&2 && add_backports; } || true
  fi
  # Without quotes: the suite is two words, or none.
  install_packages $suite"$2" && has_qemu "$1" ||
    missing "$1, version 10 or newer" "apt-get install -y --no-install-recommends $suite$2"
}

# The page is tested in Node.js 20 or newer and in Chromium. If the distribution's Node.js is older, npm provides a newer one.
has_node() { [ "$(node -p 'process.versions.node.split(".")[0]')" -ge 20 ] && command -v npm; } >/dev/null 2>&1
has_browser() { [ -n "${CHROMIUM:-}" ] || command -v chromium || command -v chromium-browser || command -v google-chrome; } >/dev/null
page_needs() {
  has_node || { install_packages nodejs npm && npm install --global node@22 && hash -r; } >&2 || true
  has_node || missing 'Node.js 20 or newer with npm' \
    'apt-get install -y --no-install-recommends nodejs npm && npm install --global node@22' || return
  has_browser || install_packages chromium fonts-dejavu-core || true
  has_browser || missing Chromium 'apt-get install -y --no-install-recommends chromium fonts-dejavu-core' || return
  npm ci --prefix host-sim/tests/web --no-audit --no-fund --loglevel error ||
    missing 'the packages for the tests of the page' 'npm ci --prefix host-sim/tests/web'
}

# The packages for the tests of the Python package, in an environment in target/python.
python_needs() {
  python3 -c 'import ensurepip' 2>/dev/null || install_packages python3 python3-venv ||
    missing 'the Python module venv' 'apt-get install -y --no-install-recommends python3-venv' || return
  python3 -m venv target/python && target/python/bin/pip install -q -r host-sim/python/tests/requirements.txt ||
    missing 'the packages for the tests of the Python package' \
      'target/python/bin/pip install -r host-sim/python/tests/requirements.txt'
}

# The oldest compiler that the workspace supports.
rust_needs() {
  cargo "+$1" --version >/dev/null 2>&1 || rustup toolchain install "$1" --profile minimal ||
    missing "Rust $1" "rustup toolchain install $1 --profile minimal"
}
