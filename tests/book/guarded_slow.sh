#!/usr/bin/env bash
# A program that is only asked for its scene changes nothing outside of its temporary folder, by whichever layer of the
# guard there is. Where there is none, nothing is run.
. "$(dirname "$0")/_program.sh"

# without CALLS COMMAND...: runs it on a kernel that lacks "unshare", "landlock", both, or neither ("").
without() {
  python3 -c '
import ctypes, os, platform, struct, sys
numbers = {"unshare": 272 if platform.machine() == "x86_64" else 97, "landlock": 444}
code = [struct.pack("HBBI", 0x20, 0, 0, 0)]  # load the number of the system call
for name in sys.argv[1].split():
    code += [struct.pack("HBBI", 0x15, 0, 1, numbers[name]), struct.pack("HBBI", 0x06, 0, 0, 0x50026)]  # fail: ENOSYS
code.append(struct.pack("HBBI", 0x06, 0, 0, 0x7FFF0000))  # allow
text = ctypes.create_string_buffer(b"".join(code))
filter = ctypes.create_string_buffer(struct.pack("HxxxxxxP", len(code), ctypes.addressof(text)))
libc = ctypes.CDLL(None)
if libc.prctl(38, 1, 0, 0, 0) or libc.prctl(22, 2, filter): sys.exit("no seccomp")
os.execvp(sys.argv[2], sys.argv[2:])' "$@"
}

mkdir kept
program kept/main <<<"#include <unistd.h>
#include <filesystem>
$ball int main() {
  std::string kept = \"$PWD/kept/\", home = getenv(\"HOME\");
  std::ofstream first(kept + \"picture.ppm\"), second(home + \"/home.ppm\");
  std::error_code error;
  std::filesystem::remove(kept + \"removed.ppm\", error);
  std::filesystem::create_symlink(kept + \"linked.ppm\", \"link.ppm\", error);
  std::ofstream(\"link.ppm\") << 1;
  if (system((\"rm -f \" + kept + \"shell.ppm\").c_str()) != 0) error.clear();
  if (fork() == 0) {
    setsid();
    usleep(300000);
    std::ofstream(kept + \"later.ppm\") << 1;
    _exit(0);
  }
  std::ofstream own(\"picture.ppm\"), above(\"../above.ppm\");
  if (!(own << 1).flush() || !(above << 1).flush()) return 4;
  camera c; c.image_width = 8; c.render(ball());
}"
fill() { for name in picture home removed linked shell later; do echo "P3 1 1 255 1 2 3" >"kept/$name.ppm"; done; }
fill
before=$(cksum kept/*)
export HOME=$PWD/kept
for lacking in '' unshare landlock; do
  without "$lacking" "$tyndall" version | grep -q '^guard  *none$' && continue
  expect 0 without "$lacking" "$tyndall" inspect kept/main.cc
  sleep 0.4
  same "files on a kernel without '$lacking'" "$(cksum kept/*)" "$before"
done
expect 0 "$tyndall" render kept/main.cc --spp 1 -q -o picture.png
expect 0 "$tyndall" convert kept/main.cc -o kept.json
expect 0 "$tyndall" chart kept/main.cc --budget 1 -o chart.svg
"$tyndall" render kept/main.cc --spp 64 -q --gamma2 -o mine.ppm
expect 0 "$tyndall" compare mine.ppm kept/main.cc
same 'files' "$(cksum kept/*)" "$before"

# No guard: one sentence, also where the environment says otherwise.
without 'unshare landlock' "$tyndall" version | grep -q '^guard  *none$' || fail 'version names a guard'
TYNDALL_TRUST=1 expect 2 without 'unshare landlock' "$tyndall" inspect kept/main.cc
complains 'kept/main.cc: is not run' 'namespaces' 'Landlock' '--trust'
same 'files' "$(cksum kept/*)" "$before"
expect 0 without 'unshare landlock' "$tyndall" inspect kept/main.cc --trust
[ -e kept/removed.ppm ] && fail 'the program does not run as it is'

finish
