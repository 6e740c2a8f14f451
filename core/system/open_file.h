#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <tuple>
#include <utility>

namespace tyndall {

/// What a file is opened for.
enum class OpenFor {
  reading,
  writing,    ///< a file that exists
  appending,  ///< to a file or pipe that exists
  adding,     ///< lines to a file, which is made if there is none
  changing,   ///< its bytes; it is made if there is none
  creating,   ///< a file that must not exist
  looking,    ///< at a file that exists and may be damaged or none of ours, without following links or waiting
  folder      ///< to lock or to synchronise it
};

inline constexpr int standard_input = 0, standard_output = 1;

/// The words of the system for an error number.
std::string error_text(int number);

/// Reads up to `size` bytes; got: how many; 0: there are no more. Returns 0, or the number of the error.
int read_some(int file, void* to, std::size_t size, std::size_t& got);

/// A file, pipe or device that is open, and closed at its end. Functions that return an int return 0, or the number of
/// the error.
class OpenFile {
 public:
  OpenFile() = default;
  explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
  /// error() says whether it could be opened. mode: of a file that is made.
  OpenFile(const std::filesystem::path& file, OpenFor purpose, unsigned mode = 0666);
  OpenFile(OpenFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)), error_(other.error_) {}
  OpenFile& operator=(OpenFile&& other) noexcept {
    std::swap(descriptor_, other.descriptor_), std::swap(error_, other.error_);
    return *this;
  }
  ~OpenFile() { close(); }

  /// Standard output under a number of its own, and a temporary file without a name.
  static OpenFile copy_of_standard_output();
  static OpenFile unnamed();
  /// The ends of a pipe, to read from and to write to.
  static std::pair<OpenFile, OpenFile> pipe();

  explicit operator bool() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  /// Why it is not open.
  int error() const { return error_; }
  int close();

  /// See read_some().
  int read(void* to, std::size_t size, std::size_t& got) const { return read_some(descriptor_, to, size, got); }
  /// All of them.
  int write(const void* bytes, std::size_t size) const;
  int seek(std::uint64_t position) const;
  int size(std::uint64_t& bytes) const;
  int truncate(std::uint64_t size) const;
  /// Waits until it is on the disk; a folder: which files it has.
  int synchronise() const;
  /// Asks the disk for room, so that it is not missed in the middle. 0 also where a file system does not say.
  int reserve(std::uint64_t size) const;
  /// Takes the lock if nobody has it; it ends with the file, or the program. EWOULDBLOCK: somebody has it.
  int try_lock() const;
  void wait_for_lock() const;
  /// Whether it still stands in a folder: it was not removed.
  bool has_name() const;
  /// Gives the file these, as far as that is permitted. What a group was allowed is not given to another group.
  int set_owner(unsigned mode, unsigned user, unsigned group) const;

 private:
  int descriptor_ = -1, error_ = 0;
};

/// Wakes a thread that waits; also from a handler of signals.
class Bell {
 public:
  /// ready(): whether the system had what it takes.
  Bell() { std::tie(heard_, rung_) = OpenFile::pipe(); }
  bool ready() const { return static_cast<bool>(heard_); }
  void ring() const;
  /// Until it rings.
  void wait() const {
    char byte = 0;
    std::size_t got = 0;
    heard_.read(&byte, 1, got);
  }
  /// What ends the waiting for a file's next bytes.
  enum class Woken { by_bytes, by_bell, by_time };
  /// seconds: that it waits at most; < 0: as long as it takes.
  Woken wait_for(int file, double seconds) const;

 private:
  OpenFile heard_, rung_;
};

/// Whether a file has bytes to be read, or has ended, within this time; < 0: as long as it takes.
bool has_bytes(int file, int milliseconds);

}  // namespace tyndall
