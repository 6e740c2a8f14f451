#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
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

  /// A temporary file without a name.
  static OpenFile unnamed();

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
  /// Takes the lock if nobody has it, or else waits for it, if that is asked for; it ends with the file, or the
  /// program. EWOULDBLOCK: somebody has it.
  int lock(bool waits = false) const;
  /// Whether it still stands in a folder: it was not removed.
  bool has_name() const;
  /// Gives the file the mode, and as far as that is permitted the owner and the group of another one, if there is one.
  /// What a group was allowed is not given to another group.
  int take_mode_and_owner(const std::filesystem::path& other) const;

 private:
  int descriptor_ = -1, error_ = 0;
};

/// Whether a file has bytes to be read, or has ended, within this time.
bool has_bytes(int file, int milliseconds);

}  // namespace tyndall
