#include "core/system/guard.h"
#include "core/system/child.h"
#include "tests/support/guards.h"
#include "tests/support/scratch.h"

#include <doctest/doctest.h>

#ifdef __linux__
#include <arpa/inet.h>
#include <linux/fs.h>
#include <linux/keyctl.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <sys/msg.h>
#include <sys/resource.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <fcntl.h>
#include <mqueue.h>
#include <sched.h>
#include <unistd.h>
#include <utime.h>

#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <sstream>
#include <thread>
#include <vector>

/// A program tries every way that we know to change something outside its folder: under each layer alone and under
/// both nothing may change, without a guard everything must. The program is this one, started again.
namespace tyndall::test::guard_test {
namespace fs = std::filesystem;

namespace {

/// What others have, outside of the program's folder.
struct Outside {
  pid_t tester = getpid(), process = 0, second_process = 0;
  int descriptor = -1, port = 0, segment = -1, queue = -1;
  long numbers_at = 0;  ///< the address of two numbers of the tester's
};

/// One way, and a folder of the same name that it tries to change.
struct Way {
  const char* name;
  std::function<void(const fs::path& folder, const Outside& outside)> act;
  bool works_everywhere = true;  ///< without a guard; what not all kernels have, and open files, may fail there, too
};

void overwrite(const fs::path& file) { std::ofstream(file) << "changed"; }

/// In a process of its own, which is waited for.
void in_child(const std::function<void()>& act) {
  const pid_t process = fork();
  if (process == 0) act(), _exit(0);
  waitpid(process, nullptr, 0);
}

sockaddr_un name_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  return address;
}

std::string abstract_name(const Outside& outside) {
  return std::string(1, '\0') + "tyndall-guard-" + std::to_string(outside.tester);
}

void connect_to(const std::string& path) {
  const sockaddr_un address = name_of(path);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + path.size());
  const int out = socket(AF_UNIX, SOCK_STREAM, 0);
  [[maybe_unused]] const int done = connect(out, reinterpret_cast<const sockaddr*>(&address), size);
}

void connect_to(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const int out = socket(AF_INET, SOCK_STREAM, 0);
  [[maybe_unused]] const int done = connect(out, reinterpret_cast<const sockaddr*>(&address), sizeof address);
}

/// The kernel sends the signal to the owner of the pipe.
void signal_by_pipe(pid_t process) {
  int ends[2];
  if (pipe(ends) != 0) return;
  fcntl(ends[0], F_SETOWN, process), fcntl(ends[0], F_SETSIG, SIGKILL), fcntl(ends[0], F_SETFL, O_ASYNC | O_NONBLOCK);
  [[maybe_unused]] const auto done = write(ends[1], "x", 1);
}

void write_memory(const Outside& outside) {
  const int out = open(("/proc/" + std::to_string(outside.tester) + "/mem").c_str(), O_RDWR);
  const int changed = 1;
  [[maybe_unused]] const auto done = pwrite(out, &changed, sizeof changed, outside.numbers_at);
}

void copy_to_memory(const Outside& outside) {
  int changed = 1;
  const iovec from{&changed, sizeof changed};
  const iovec to{reinterpret_cast<void*>(outside.numbers_at + long(sizeof changed)), sizeof changed};
  process_vm_writev(outside.tester, &from, 1, &to, 1, 0);
}

void set_flags(const fs::path& file) {
  const int in = open(file.c_str(), O_RDONLY);
  int flags = 0;
  ioctl(in, FS_IOC_GETFLAGS, &flags);
  flags |= FS_NODUMP_FL;
  ioctl(in, FS_IOC_SETFLAGS, &flags);
}

void write_later(const fs::path& file) {
  in_child([&] {
    setsid();
    if (fork() != 0) _exit(0);
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    overwrite(file);
  });
}

/// In namespaces of its own a process has all rights, and may mount.
void remount(const fs::path& folder) {
  if (unshare(CLONE_NEWUSER | CLONE_NEWNS) == 0) {
    mount(folder.c_str(), folder.c_str(), nullptr, MS_BIND, nullptr);
    for (const char* point : {folder.c_str(), "/"}) mount(nullptr, point, nullptr, MS_BIND | MS_REMOUNT, nullptr);
  }
  overwrite(folder / "file");
}

void send_message(int queue) {
  const struct {
    long type;
    char text[8];
  } message{1, "changed"};
  msgsnd(queue, &message, sizeof message.text, IPC_NOWAIT);
}

std::string shared_name(const Outside& outside) { return "/tyndall-guard-" + std::to_string(outside.tester); }

std::vector<Way> ways_of_files() {
  const auto file = [](auto act) { return [act](const fs::path& v, const Outside&) { act((v / "file").string()); }; };
  const auto folder = [](auto act) { return [act](const fs::path& v, const Outside&) { act(v); }; };
  return {
      {"ofstream", file([](auto f) { overwrite(f); })},
      {"fopen", file([](auto f) {
         if (FILE* out = std::fopen(f.c_str(), "w")) std::fclose(out);
       })},
      {"open-truncate", file([](auto f) { open(f.c_str(), O_RDONLY | O_TRUNC); })},
      {"open-ioctl", file([](auto f) { open(f.c_str(), O_ACCMODE | O_TRUNC); })},
      {"truncate", file([](auto f) { [[maybe_unused]] const int done = truncate(f.c_str(), 0); })},
      {"openat2", file([](auto f) {
         const std::uint64_t how[3] = {O_RDONLY | O_TRUNC, 0, 0};
         syscall(437, AT_FDCWD, f.c_str(), how, sizeof how);
       })},
      {"parents", file([](auto f) { overwrite(fs::relative(f)); })},
      {"home", folder([](auto v) { setenv("HOME", v.c_str(), 1), overwrite(fs::path(std::getenv("HOME")) / "file"); })},
      {"link", file([](auto f) { fs::create_symlink(f, "link"), overwrite("link"); })},
      {"root", file([](auto f) { overwrite("/proc/self/root" + f); })},
      {"tester-root",
       [](const fs::path& v, const Outside& outside) {
         overwrite("/proc/" + std::to_string(outside.tester) + "/root" + (v / "file").string());
       }},
      {"descriptor",
       [](const fs::path&, const Outside& outside) {
         [[maybe_unused]] const auto done = write(outside.descriptor, "changed", 7);
       },
       false},
      {"remove", file([](auto f) { std::remove(f.c_str()); })},
      {"filesystem-remove", folder([](auto v) {
         std::error_code error;
         fs::remove_all(v, error);
       })},
      {"shell", file([](auto f) { [[maybe_unused]] const int done = std::system(("rm -f '" + f + "'").c_str()); })},
      {"rename", file([](auto f) { std::rename(f.c_str(), (f + ".new").c_str()); })},
      {"replace", file([](auto f) { overwrite("mine"), std::rename("mine", f.c_str()); })},
      {"hard-link", file([](auto f) { [[maybe_unused]] const int done = ::link(f.c_str(), (f + ".new").c_str()); })},
      {"symlink", folder([](auto v) { [[maybe_unused]] const int done = symlink("file", (v / "new").c_str()); })},
      {"mkdir", folder([](auto v) { mkdir((v / "new").c_str(), 0700); })},
      {"rmdir", folder([](auto v) { rmdir((v / "empty").c_str()); })},
      {"mkfifo", folder([](auto v) { mkfifo((v / "new").c_str(), 0600); })},
      {"chmod", file([](auto f) { chmod(f.c_str(), 0777); })},
      {"fchmod", file([](auto f) { fchmod(open(f.c_str(), O_RDONLY), 0777); })},
      {"fchmodat2", file([](auto f) { syscall(452, AT_FDCWD, f.c_str(), 0777, 0); }), false},
      {"chown", file([](auto f) { [[maybe_unused]] const int done = ::chown(f.c_str(), geteuid(), getegid()); })},
      {"utime", file([](auto f) { utime(f.c_str(), nullptr); })},
      {"utimensat", folder([](auto v) { utimensat(AT_FDCWD, (v / "empty").c_str(), nullptr, 0); })},
      {"setxattr", file([](auto f) { setxattr(f.c_str(), "user.changed", "1", 1, 0); }), false},
      {"flags", file([](auto f) { set_flags(f); }), false},
      {"fork", file([](auto f) { in_child([&] { overwrite(f); }); })},
      {"later", file([](auto f) { write_later(f); })},
      {"remount", folder([](auto v) { in_child([&] { remount(v); }); })},
      {"bind", folder([](auto v) {
         const sockaddr_un address = name_of(fs::relative(v / "new"));
         const int out = socket(AF_UNIX, SOCK_STREAM, 0);
         [[maybe_unused]] const int done = bind(out, reinterpret_cast<const sockaddr*>(&address), sizeof address);
       })},
  };
}

/// Those that reach something else than the victim.
std::vector<Way> other_ways() {
  const auto way = [](auto act) { return [act](const fs::path&, const Outside& outside) { act(outside); }; };
  return {
      {"named-socket", [](const fs::path& v, const Outside&) { connect_to(fs::relative(v / "socket")); }},
      {"abstract-socket", way([](auto& o) { connect_to(abstract_name(o)); })},
      {"network", way([](auto& o) { connect_to(o.port); })},
      {"memory", way([](auto& o) { write_memory(o); })},
      {"vm-write", way([](auto& o) { copy_to_memory(o); })},
      {"nice", way([](auto& o) { setpriority(PRIO_PROCESS, static_cast<id_t>(o.process), 19); })},
      {"prlimit", way([](auto& o) {
         const rlimit limit{77, 77};
         prlimit(o.process, RLIMIT_NOFILE, &limit, nullptr);
       })},
      {"shared-memory", way([](auto& o) {
         void* at = shmat(o.segment, nullptr, 0);
         if (at != reinterpret_cast<void*>(-1)) *static_cast<char*>(at) = 1;
       })},
      {"message", way([](auto& o) { send_message(o.queue); })},
      {"named-memory", way([](auto& o) { open(("/dev/shm" + shared_name(o)).c_str(), O_CREAT | O_RDWR, 0600); })},
      {"named-queue", way([](auto& o) { mq_open(shared_name(o).c_str(), O_CREAT | O_RDWR, 0600, nullptr); }), false},
      {"key", way([](auto& o) { syscall(SYS_add_key, "user", shared_name(o).c_str(), "1", 1, KEY_SPEC_USER_KEYRING); }),
       false},
      {"signal-by-pipe", way([](auto& o) { signal_by_pipe(o.second_process); })},
      {"kill", way([](auto& o) { kill(o.process, SIGKILL); })},
  };
}

std::vector<Way> all_ways() {
  std::vector<Way> ways = ways_of_files();
  for (const Way& way : other_ways()) ways.push_back(way);
  return ways;
}

/// A socket that is listened to, at the name, or at a free port.
int listening(const std::string& name) {
  const sockaddr_un address = name_of(name);
  const int socket = ::socket(name.empty() ? AF_INET : AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (!name.empty()) {
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    REQUIRE(bind(socket, reinterpret_cast<const sockaddr*>(&address), size) == 0);
  }
  REQUIRE(listen(socket, 4) == 0);
  return socket;
}

int port_of(int socket) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  REQUIRE(getsockname(socket, reinterpret_cast<sockaddr*>(&address), &size) == 0);
  return ntohs(address.sin_port);
}

/// A process that waits to be ended.
pid_t waiting_process() {
  const pid_t process = fork();
  if (process == 0)
    for (;;) pause();
  return process;
}

volatile int numbers[2];

/// All that can be changed, and what of it was.
class Victims {
 public:
  explicit Victims(const fs::path& root) : root_(root) {
    for (const Way& way : all_ways()) {
      fs::create_directories(root / way.name / "empty");
      write_text(root / way.name / "file", "kept");
    }
    named_ = listening(fs::relative(root / "named-socket/socket"));
    abstract_ = listening(abstract_name(outside_));
    network_ = listening("");
    outside_.port = port_of(network_);
    outside_.process = waiting_process(), outside_.second_process = waiting_process();
    outside_.descriptor = open((root / "descriptor/file").c_str(), O_WRONLY);
    outside_.segment = shmget(IPC_PRIVATE, 4096, 0600);
    memory_ = static_cast<char*>(shmat(outside_.segment, nullptr, 0));
    outside_.queue = msgget(IPC_PRIVATE, 0600);
    outside_.numbers_at = reinterpret_cast<long>(&numbers);
    for (volatile int& number : numbers) number = 0;
    for (const Way& way : all_ways()) before_[way.name] = state_of(way.name);
  }
  ~Victims() {
    for (const pid_t process : {outside_.process, outside_.second_process})
      kill(process, SIGKILL), waitpid(process, nullptr, 0);
    for (const int one : {named_, abstract_, network_, outside_.descriptor}) close(one);
    shmdt(memory_), shmctl(outside_.segment, IPC_RMID, nullptr), msgctl(outside_.queue, IPC_RMID, nullptr);
    fs::remove("/dev/shm" + shared_name(outside_));
  }
  Victims(const Victims&) = delete;
  Victims& operator=(const Victims&) = delete;

  const Outside& outside() const { return outside_; }
  /// What the way could change, as text.
  std::string state_of(const std::string& name) const {
    std::ostringstream state;
    state << std::boolalpha << state_of_files(root_ / name) << other_change(name);
    return state.str();
  }
  bool has_changed(const std::string& name) const { return state_of(name) != before_.at(name); }

 private:
  static std::string state_of_files(const fs::path& folder) {
    std::set<std::string> files;
    std::error_code error;
    for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
      struct stat file {};
      lstat(at->path().c_str(), &file);
      files.insert(at->path().string() + " " + std::to_string(file.st_mode) + " " +
                   std::to_string(file.st_ctim.tv_sec) + "." + std::to_string(file.st_ctim.tv_nsec) +
                   (at->is_regular_file() ? read_text(*at) : ""));
    }
    return std::accumulate(files.begin(), files.end(), std::string());
  }
  bool other_change(const std::string& name) const {
    const std::map<std::string, std::function<bool()>> changes{
        {"named-socket", [&] { return accept(named_, nullptr, nullptr) >= 0; }},
        {"abstract-socket", [&] { return accept(abstract_, nullptr, nullptr) >= 0; }},
        {"network", [&] { return accept(network_, nullptr, nullptr) >= 0; }},
        {"memory", [&] { return numbers[0] != 0; }},
        {"vm-write", [&] { return numbers[1] != 0; }},
        {"nice", [&] { return getpriority(PRIO_PROCESS, static_cast<id_t>(outside_.process)) == 19; }},
        {"prlimit",
         [&] {
           rlimit limit{};
           return prlimit(outside_.process, RLIMIT_NOFILE, nullptr, &limit) == 0 && limit.rlim_cur == 77;
         }},
        {"shared-memory", [&] { return *memory_ != 0; }},
        {"message",
         [&] {
           msqid_ds queue{};
           return msgctl(outside_.queue, IPC_STAT, &queue) == 0 && queue.msg_qnum > 0;
         }},
        {"named-memory", [&] { return fs::exists("/dev/shm" + shared_name(outside_)); }},
        {"named-queue", [&] { return mq_unlink(shared_name(outside_).c_str()) == 0; }},
        {"key", [&] { return has_key(); }},
        {"signal-by-pipe", [&] { return waitpid(outside_.second_process, nullptr, WNOHANG) != 0; }},
        {"kill", [&] { return waitpid(outside_.process, nullptr, WNOHANG) != 0; }}};
    const auto change = changes.find(name);
    return change != changes.end() && change->second();
  }
  bool has_key() const {
    const long key =
        syscall(SYS_keyctl, KEYCTL_SEARCH, KEY_SPEC_USER_KEYRING, "user", shared_name(outside_).c_str(), 0);
    if (key > 0) syscall(SYS_keyctl, KEYCTL_UNLINK, key, KEY_SPEC_USER_KEYRING);
    return key > 0;
  }

  fs::path root_;
  Outside outside_;
  int named_ = -1, abstract_ = -1, network_ = -1;
  char* memory_ = nullptr;
  std::map<std::string, std::string> before_;
};

std::string text_of(const fs::path& root, const Outside& o) {
  std::ostringstream text;
  for (const long number : {long(o.tester), long(o.process), long(o.second_process), long(o.descriptor), long(o.port),
                            long(o.segment), long(o.queue), o.numbers_at})
    text << number << " ";
  text << root.string();
  return text.str();
}

constexpr const char* variable = "TYNDALL_TEST_OUTSIDE";

/// Runs the program that tries all ways, and waits until it would have done the last.
ChildEnd try_all(const GuardLayers& layers, const fs::path& root, const Outside& outside) {
  ChildPlan plan;
  plan.command = {fs::read_symlink("/proc/self/exe").string(), "--no-skip", "--source-file=*/guard_test.cpp",
                  "--test-case=guard: the program that tries all ways"};
  plan.folder = plan.own_folder = fs::canonical(root) / "own";
  fs::create_directories(plan.folder);
  plan.environment = {variable + ("=" + text_of(fs::canonical(root), outside))};
  plan.guard = layers;
  const ChildEnd end = run_child(plan);
  std::this_thread::sleep_for(std::chrono::milliseconds(250));
  return end;
}

}  // namespace

TEST_CASE("guard: the program that tries all ways" * doctest::skip()) {
  const char* told = std::getenv(variable);
  if (!told) return;
  Outside o;
  std::string root;
  std::istringstream(told) >> o.tester >> o.process >> o.second_process >> o.descriptor >> o.port >> o.segment >>
      o.queue >> o.numbers_at >> root;
  std::signal(SIGPIPE, SIG_IGN);
  for (const Way& way : all_ways()) way.act(fs::path(root) / way.name, o);
  overwrite("last");
  fs::create_directories("a/b"), overwrite("a/b/mine");
  std::_Exit(fs::file_size("last") == 7 && fs::remove("a/b/mine") ? 7 : 1);
}

TEST_CASE("guard: without one, every way changes something") {
  const fs::path root = scratch_folder("guard_none");
  const Victims victims(root);
  CHECK(try_all({}, root, victims.outside()).exit_code == 7);
  CHECK(all_ways().size() >= 40);
  for (const Way& way : all_ways()) {
    CAPTURE(std::string(way.name));
    const bool changed = victims.has_changed(way.name);
    CHECK((changed || !way.works_everywhere));
  }
}

TEST_CASE("guard: nothing outside the folder changes under any layer, and the folder can be written to") {
  if (!available_guard().any()) MESSAGE("skipped: this system has no guard");
  for (const GuardLayers& layers : guards()) {
    CAPTURE(layers.namespaces);
    CAPTURE(layers.landlock);
    const fs::path root = scratch_folder("guard_layers");
    const Victims victims(root);
    CHECK(try_all(layers, root, victims.outside()).exit_code == 7);
    for (const Way& way : all_ways()) {
      CAPTURE(std::string(way.name));
      CHECK_FALSE(victims.has_changed(way.name));
    }
  }
}

}  // namespace tyndall::test::guard_test
#endif
