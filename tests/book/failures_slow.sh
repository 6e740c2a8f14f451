#!/usr/bin/env bash
# Programs, compilers and temporary folders that fail: one line each, nothing is left behind, nothing of the reader's is
# written to.
. "$(dirname "$0")/_program.sh"
mkdir temporary
export TMPDIR=$PWD/temporary

# left WHAT: fails if a temporary folder or a process of WHAT is still there.
left() {
  [ -z "$(ls -A temporary)" ] || fail "$1: left in the temporary folder: $(find temporary | head -3)"
  sleep 0.2
  if pgrep -f "$PWD/temporary" >/dev/null; then fail "$1: a process is left"; fi
}
# fails CODE NAME TEXT...: the program from standard input fails so.
fails() {
  local code=$1 name=$2
  shift 2
  program "$name"
  expect "$code" "$tyndall" convert "$name.cc" -o failed.json
  complains "$name.cc" "$@"
  left "$name"
}
render="camera c; c.image_width = 8; c.samples_per_pixel = 2; c.render(ball());"

fails 2 crash 'was ended by SIGSEGV' 'before the colour of its first ray' <<<'int main() { volatile int* volatile p = nullptr; *p = 1; }'
fails 2 thrown 'was ended by SIGABRT' "an instance of 'int'" <<<'int main() { throw 1; }'
fails 2 leaves 'ended with exit code 4 before the colour of its first ray' 'its last words: "no model.obj"' <<<'int main() { std::cerr << "reading\nno model.obj\n"; exit(4); }'
fails 2 memory 'ended with exit code 4' <<<'int main() { for (int k = 0; k < 4096; ++k) if (!malloc(std::size_t(1) << 30)) exit(4); exit(5); }'
fails 2 nothing 'ended with exit code 0 before the colour of its first ray' <<<'int main() {}'
fails 2 input 'reads standard input' <<<"$ball int main() { int n = 1; std::cin >> n; $render }"
if [ -e /proc/self/syscall ]; then
  fails 2 old_input 'reads standard input' <<<"$ball int main() { int n = 1; if (scanf(\"%d\", &n) > 0) n = 2; $render }"
fi

# What a program has started ends with it.
program forks <<<"#include <unistd.h>
$ball int main() { if (fork() == 0) { fork(); sleep(1000); } $render }"
expect 0 "$tyndall" inspect forks.cc
left forks

# Programs write files where they like: they run in another folder, two levels deep.
mkdir -p kept/inner
echo kept | tee kept/inner/image.ppm kept/image.ppm image.ppm kept/inner/log.txt >/dev/null
program kept/inner/main <<<"$ball int main() { for (auto f : {\"image.ppm\", \"../image.ppm\", \"../../image.ppm\"}) std::ofstream(f) << 1;
  std::ofstream(\"log.txt\", std::ios::app) << 1; std::remove(\"log.txt\"); $render }"
expect 0 "$tyndall" inspect kept/inner/main.cc
same 'files of the reader' "$(cat kept/inner/image.ppm kept/image.ppm image.ppm kept/inner/log.txt | tr '\n' ' ')" 'kept kept kept kept '
left writes
expect 2 "$tyndall" convert kept/inner/main.cc -o kept/inner/main.cc
expect 2 "$tyndall" render kept/inner/main.cc -o kept/inner/main.cc

# Compilers.
program good <<<"$ball int main() { $render }"
with_compiler() { # CODE SCRIPT TEXT...: where $CXX is a program that does that
  local code=$1
  printf '#!/bin/sh\n%s\n' "$2" >compiler
  chmod +x compiler
  shift 2
  CXX=$PWD/compiler expect "$code" "$tyndall" inspect good.cc
  complains "$@"
  left "$1"
}
with_compiler 3 'kill -9 $$' 'compiler was ended by SIGKILL' 'while it compiled good.cc'
with_compiler 3 'echo "c++: fatal error: Killed signal terminated program cc1plus" >&2; exit 1' 'was ended by SIGKILL'
with_compiler 3 'echo "cc1plus: error: No space left on device" >&2; exit 1' 'No space left on device'
with_compiler 2 'echo "good.cc:3:1: error: nonsense" >&2; exit 1' 'good.cc:3:1: nonsense'
CXX=./nothing expect 3 "$tyndall" inspect good.cc
complains 'CXX: found "./nothing", which cannot be run, expected a C++ compiler'
CXX="${CXX:-c++} -DUNUSED" expect 0 "$tyndall" inspect good.cc
expect 3 env -u CXX PATH=/nowhere "$tyndall" inspect good.cc
complains 'no C++ compiler was found' 'apt install g++'

# Temporary folders.
TMPDIR=$PWD/missing expect 3 "$tyndall" inspect good.cc
complains 'missing: cannot make a temporary folder'
if unshare -rm true 2>/dev/null; then
  in_folder() { # MOUNT-OPTIONS: inspect where the temporary folder is mounted so
    mkdir -p mounted
    unshare -rm bash -c 'mount -t tmpfs -o "$1" none mounted && TMPDIR=$PWD/mounted "$2" inspect good.cc' _ "$1" "$tyndall" >out 2>err </dev/null
  }
  in_folder noexec
  same 'exit code of noexec' $? 3
  complains 'noexec' 'TMPDIR names another'
  in_folder size=64k
  same 'exit code of a full folder' $? 3
  complains 'No space left on device'
fi

# Signals, while it is compiled and while it runs.
program endless <<<'int main() { std::ofstream("mark") << 1; for (volatile int i = 0;;) i = 1; }'
printf '#!/bin/sh\necho 1 >mark; sleep 1000 & sleep 1000\n' >compiler
interrupted() { # SIGNAL CODE TEXT: what runs in the background ends so
  local code=0
  for _ in $(seq 600); do [ -n "$(find temporary \( -name mark -o -path '*/written/*' \) -size +0)" ] && break || sleep 0.1; done
  kill -"$1" "$!"
  wait "$!" || code=$?
  same "exit code after SIG$1 $3" "$code" "$2"
  complains "$3"
  left "SIG$1"
}
for signal in INT:130 TERM:143 HUP:129; do
  CXX=$PWD/compiler "$tyndall" inspect good.cc >out 2>err </dev/null &
  interrupted "${signal%:*}" "${signal#*:}" 'interrupted while it was compiled'
done
"$tyndall" render endless.cc -o x.png >out 2>err </dev/null &
interrupted INT 130 'interrupted while it ran'
"$tyndall" chart endless.cc -o x.svg >out 2>err </dev/null & # it watches signals itself, too
interrupted TERM 143 'interrupted while it ran'

finish
