#include "core/system/guard.h"

#ifdef __linux__
#include <linux/audit.h>
#include <linux/capability.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sys/ioctl.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <iterator>
#endif

namespace tyndall {

std::string guard_text(const GuardLayers& layers) {
  if (layers.namespaces) return layers.landlock > 0 ? "namespaces and Landlock" : "namespaces";
  return layers.landlock > 0 ? "Landlock" : "none";
}

#ifdef __linux__
namespace {

constexpr const char* usable_devices[] = {"/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom"};

/// Writes to a file of /proc.
bool write_line(const char* file, const char* text) {
  const int out = open(file, O_WRONLY | O_CLOEXEC);
  if (out < 0) return false;
  const std::size_t size = std::strlen(text);
  const bool written = write(out, text, size) == static_cast<ssize_t>(size);
  close(out);
  return written;
}

/// Maps a user or a group to itself, by a file of /proc.
bool map_to_itself(const char* file, unsigned id) {
  char text[32];
  char* end = std::to_chars(text, text + 10, id).ptr;
  *end++ = ' ';
  end = std::to_chars(end, end + 10, id).ptr;
  std::strcpy(end, " 1\n");
  return write_line(file, text);
}

struct MountAttributes {  // as mount_setattr(2) has them; the headers of the system and of the kernel collide
  std::uint64_t set = 0, clear = 0, propagation = 0, user_namespace = 0;
};
constexpr std::uint64_t read_only = 1, no_setuid = 2, no_devices = 4;

bool set_mount(const char* point, int flags, const MountAttributes& attributes) {
  return syscall(SYS_mount_setattr, AT_FDCWD, point, flags, &attributes, sizeof attributes) == 0;
}

/// All files read-only but the folder, and no devices but harmless ones. What is mounted later stays outside.
bool lock_files(const char* folder) {
  if (mount(folder, folder, nullptr, MS_BIND, nullptr) != 0) return false;
  for (const char* device : usable_devices) mount(device, device, nullptr, MS_BIND, nullptr);
  if (!set_mount("/", AT_RECURSIVE, {read_only | no_setuid | no_devices, 0, MS_PRIVATE})) return false;
  for (const char* device : usable_devices) set_mount(device, 0, {0, no_devices});
  return set_mount(folder, 0, {0, read_only});
}

/// The first process of the new namespace: when it ends, the kernel ends all others there. It lives until nobody can
/// write to the pipe any more.
[[noreturn]] void be_first_process(int pipe) {
  std::signal(SIGCHLD, SIG_IGN);  // nobody waits for orphans
  dup2(pipe, 0);
  syscall(SYS_close_range, 1U, ~0U, 0U);  // also the end of the pipe that this process has
  char nothing;
  while (read(0, &nothing, 1) < 0 && errno == EINTR) {
  }
  _exit(0);
}

// Rights of Landlock that the kernel's headers may be too old to know, by its version.
constexpr std::uint64_t refer = 1U << 13, truncating = 1U << 14, device_ioctl = 1U << 15;

std::uint64_t rights_to_change(int version) {
  std::uint64_t rights = LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
                         LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_DIR |
                         LANDLOCK_ACCESS_FS_MAKE_REG | LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO |
                         LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SYM;
  if (version >= 2) rights |= refer;
  if (version >= 3) rights |= truncating;
  if (version >= 5) rights |= device_ioctl;
  return rights;
}

bool grant(int rules, const char* path, std::uint64_t rights) {
  landlock_path_beneath_attr rule{};
  rule.allowed_access = rights;
  rule.parent_fd = open(path, O_PATH | O_CLOEXEC);
  const bool added = syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0U) == 0;
  close(rule.parent_fd);
  return added;
}

bool enter_landlock(int version, const char* folder) {
  const std::uint64_t rights = rights_to_change(version);
  landlock_ruleset_attr handled{};
  handled.handled_access_fs = rights;
  const auto rules =
      static_cast<int>(syscall(SYS_landlock_create_ruleset, &handled, sizeof handled.handled_access_fs, 0U));
  if (rules < 0 || !grant(rules, folder, rights)) return false;
  for (const char* device : usable_devices) grant(rules, device, rights & (LANDLOCK_ACCESS_FS_WRITE_FILE | truncating));
  const bool entered = syscall(SYS_landlock_restrict_self, rules, 0U) == 0;
  close(rules);
  return entered;
}

#if defined(__x86_64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t architecture = 0;  // where numbers of calls are not known, there is no guard
#endif

/// A filter of system calls (seccomp, in the language of BPF). Refused calls fail with an error; none ends the process.
class CallFilter {
 public:
  CallFilter() {
    load(offsetof(seccomp_data, arch));
    add(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0);
    fail(ENOSYS);
    load(offsetof(seccomp_data, nr));
  }
  void refuse(std::initializer_list<long> calls) {
    for (const long call : calls) {
      add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, 1);
      fail(EPERM);
    }
  }
  /// Refuses all calls from this number on, as a kernel does that does not know them.
  void end_at(std::uint32_t call) {
    add(BPF_JMP | BPF_JGE | BPF_K, call, 0, 1);
    fail(ENOSYS);
  }
  /// Allows the call only where the masked argument has one of these values, or, if that is `refused`, only where it
  /// has none of them. Takes the lower half of the argument; the values lead beyond the refusal, or to it.
  void test_argument(long call, int argument, std::initializer_list<std::uint32_t> values, std::uint32_t mask = ~0U,
                     bool refused = false) {
    auto left = static_cast<std::uint8_t>(values.size());
    add(BPF_JMP | BPF_JEQ | BPF_K, static_cast<std::uint32_t>(call), 0, static_cast<std::uint8_t>(left + 4 + refused));
    load(offsetof(seccomp_data, args) + 8 * static_cast<std::size_t>(argument));
    add(BPF_ALU | BPF_AND | BPF_K, mask, 0, 0);
    for (const std::uint32_t value : values) add(BPF_JMP | BPF_JEQ | BPF_K, value, left--, 0);
    if (refused) add(BPF_JMP | BPF_JA, 1, 0, 0);
    fail(EPERM);
    load(offsetof(seccomp_data, nr));
  }
  /// From here on in force; all else is allowed.
  bool install() {
    add(BPF_RET | BPF_K, SECCOMP_RET_ALLOW, 0, 0);
    const sock_fprog program{size_, code_};
    return size_ < std::size(code_) && prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
  }

 private:
  void add(int operation, std::uint32_t value, std::uint8_t if_true, std::uint8_t if_false) {
    if (size_ < std::size(code_)) code_[size_++] = {static_cast<std::uint16_t>(operation), if_true, if_false, value};
  }
  void load(std::size_t offset) { add(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset), 0, 0); }
  void fail(std::uint32_t error) { add(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | error, 0, 0); }

  sock_filter code_[320];
  std::uint16_t size_ = 0;
};

/// What neither read-only mounts nor Landlock can see: sockets that have a name, keys that the user's processes share.
/// Linux 5.0 is all that the program sees: what came later has ways around filters (io_uring), old ways under new
/// numbers (fchmodat2, setxattrat), or handles of other processes. Libraries do without.
void refuse_in_any_case(CallFilter& filter) {
  filter.end_at(424);  // the first call of Linux 5.1, on all architectures
  filter.refuse({SYS_socket, SYS_socketpair, SYS_add_key, SYS_request_key, SYS_keyctl});
}

/// What namespaces refuse, and Landlock does not: what belongs to a file beside its contents, other processes, IPC.
void refuse_without_namespaces(CallFilter& filter, int landlock) {
  filter.refuse({SYS_fchmod, SYS_fchmodat, SYS_fchown, SYS_fchownat, SYS_utimensat, SYS_setxattr, SYS_lsetxattr,
                 SYS_fsetxattr, SYS_removexattr, SYS_lremovexattr, SYS_fremovexattr});
  filter.test_argument(SYS_ioctl, 1, {TCGETS, TIOCGWINSZ, FIONREAD, FIONBIO, FIOCLEX, FIONCLEX});
#ifdef __x86_64__
  filter.refuse({SYS_chmod, SYS_chown, SYS_lchown, SYS_utime, SYS_utimes, SYS_futimesat});
#endif
  if (landlock < 3) {
    filter.refuse({SYS_truncate});
    const std::uint32_t mask = O_TRUNC | O_ACCMODE;  // Landlock sees those that open to write
    filter.test_argument(SYS_openat, 2, {O_TRUNC, O_TRUNC | O_ACCMODE}, mask, true);
#ifdef __x86_64__
    filter.test_argument(SYS_open, 1, {O_TRUNC, O_TRUNC | O_ACCMODE}, mask, true);
#endif
  }
  filter.refuse({SYS_shmget, SYS_shmat, SYS_shmctl, SYS_semget, SYS_semop, SYS_semtimedop, SYS_semctl, SYS_msgget,
                 SYS_msgsnd, SYS_msgrcv, SYS_msgctl, SYS_mq_open, SYS_mq_unlink});
  // All stay in one process group, so that all can be ended; signals and priorities are for nobody else.
  const auto self = static_cast<std::uint32_t>(getpid());
  filter.refuse({SYS_setsid, SYS_setpgid, SYS_tkill, SYS_rt_tgsigqueueinfo, SYS_setpriority, SYS_ioprio_set,
                 SYS_migrate_pages, SYS_move_pages});
  for (const long call : {SYS_kill, SYS_tgkill, SYS_rt_sigqueueinfo, SYS_prlimit64, SYS_sched_setaffinity,
                          SYS_sched_setscheduler, SYS_sched_setparam, SYS_sched_setattr})
    filter.test_argument(call, 0, {0, self});
  filter.test_argument(SYS_fcntl, 1, {F_SETOWN, F_SETOWN_EX, F_SETSIG}, ~0U, true);
}

bool drop_capabilities() {
  __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct none[2]{};
  return syscall(SYS_capset, &header, none) == 0;
}

/// Whether a process can be put under this guard.
bool works(const GuardLayers& layers, const char* folder) {
  if (architecture == 0) return false;
  const pid_t process = fork();
  if (process == 0) {
    int life = -1;
    _exit(enter_namespaces(layers, folder, life) == 0 && restrict_self(layers, folder) == 0 ? 0 : 1);
  }
  int status = 1;
  while (process > 0 && waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status == 0;
}

}  // namespace

const GuardLayers& available_guard() {
  static const GuardLayers layers = [] {
    const long landlock = syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
    GuardLayers found{works({true, 0}, "/dev/null"), static_cast<int>(landlock)};
    if (landlock <= 0 || !works({false, found.landlock}, "/")) found.landlock = 0;
    return found;
  }();
  return layers;
}

int enter_namespaces(const GuardLayers& layers, const char* folder, int& life) {
  if (!layers.namespaces) return 0;
  const unsigned user = geteuid(), group = getegid();
  int ends[2];
  if (unshare(CLONE_NEWUSER | CLONE_NEWNS | CLONE_NEWPID | CLONE_NEWIPC | CLONE_NEWNET) != 0 ||
      !write_line("/proc/self/setgroups", "deny") || !map_to_itself("/proc/self/uid_map", user) ||
      !map_to_itself("/proc/self/gid_map", group) || !lock_files(folder) || prctl(PR_SET_DUMPABLE, 0) != 0 ||
      pipe2(ends, O_CLOEXEC) != 0)
    return errno;
  const pid_t first = fork();
  if (first < 0) return errno;
  if (first == 0) be_first_process(ends[0]);
  close(ends[0]);
  life = ends[1];
  return 0;
}

int restrict_self(const GuardLayers& layers, const char* folder) {
  if (!layers.any()) return 0;
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || !drop_capabilities()) return errno;
  if (layers.landlock > 0 && !enter_landlock(layers.landlock, folder)) return errno;
  CallFilter filter;
  refuse_in_any_case(filter);
  if (!layers.namespaces) refuse_without_namespaces(filter, layers.landlock);
  return filter.install() ? 0 : errno;
}

#else

const GuardLayers& available_guard() {
  static const GuardLayers none;
  return none;
}

#endif

}  // namespace tyndall
