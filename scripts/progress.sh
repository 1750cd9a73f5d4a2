# For the other scripts: builds with progress on a terminal, and calmly where nobody watches. Standard output is left to
# results; what is said here goes to standard error.

say() { echo "$*" >&2; }

# The last lines of a log, after something went wrong.
show_end() { tail -n "$2" "$1" >&2; }

# build PRESET: configures and builds it in build/PRESET. The whole output is in build/PRESET/build.log.
build() {
  # A compiler cache serves all checkouts, wherever they are.
  export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=1
  local folder=build/$1 log=build/$1/build.log start=$SECONDS
  mkdir -p "$folder"
  if ! cmake --preset "$1" >"$log" 2>&1; then
    show_end "$log" 40
    say "the build could not be prepared"
    return 1
  fi
  if ninja -C "$folder" -n 2>/dev/null | grep -q 'no work to do'; then return 0; fi
  if [ ! -e "$folder/dynalin" ]; then
    local long="a quarter of an hour or so"
    [ "$1" != test ] || long="some twenty minutes, with all tests,"
    say "building Dynalin, which takes $long the first time"
  fi
  if [ -t 2 ]; then
    # Ninja sees a terminal and keeps its status on one line.
    NINJA_STATUS='building %f of %t: ' cmake --build --preset "$1" >&2 || return 1
  else
    if ! cmake --build --preset "$1" >>"$log" 2>&1; then
      show_end "$log" 60
      say "the build failed; all of its output is in $folder/build.log"
      return 1
    fi
  fi
  say "built in $((SECONDS - start)) s; the program is $PWD/$folder/dynalin"
}
