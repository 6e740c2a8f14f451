#pragma once
#include "core/image/pnm_reader.h"
#include "core/render/sample_source.h"
#include "core/system/locks.h"
#include "core/system/open_file.h"

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

/// A picture that another program writes into a pipe, as P3 or P6, while its rows are shown.
namespace tyndall {

/// How much of an arriving picture is there.
struct Arrival {
  int rows = 0;        ///< whole ones
  bool ended = false;  ///< no further pixels will come
  std::string said{};  ///< what the user should know at the end, a sentence; "": nothing
  bool operator==(const Arrival&) const = default;
};

/// What a file that cannot be read twice begins with, up to the byte that tells a picture from a scene. Throws IoError.
struct Beginning {
  std::string bytes;        ///< "": there are none
  bool is_picture = false;  ///< "P" and a digit
  bool is_scene = false;    ///< {, // or /*, behind white space or a byte order mark; nothing but white space, too
};
Beginning beginning_of(int file);

/// What a file of neither kind begins with, as messages show it: what is there of its first line.
std::string first_line_of(int file, std::string begin);

/// Reads a picture on a thread of its own, and goes on reading what nobody wants after its last pixel or after damage,
/// so that the program which writes it never has to wait. The pixels that have come are a source of samples.
class ArrivingPicture {
 public:
  /// Waits for the picture's size. file: stays the caller's; begin: its first bytes, which were read already; name:
  /// what messages call it. Throws UsageError for what is no such picture.
  ArrivingPicture(int file, const std::string& begin, const std::string& name, PpmCurve curve);
  ~ArrivingPicture() { stop(); }
  ArrivingPicture(const ArrivingPicture&) = delete;
  ArrivingPicture& operator=(const ArrivingPicture&) = delete;

  int width() const { return static_cast<int>(reader_.header()->width); }
  int height() const { return static_cast<int>(reader_.header()->height); }
  /// Of black where no pixel has come yet.
  std::shared_ptr<const SampleSource> source() const { return source_; }

  /// Begins to read the pixels. on_news: called from a thread when arrival() has changed, at most ten times a second,
  /// less often for pictures of more than 300,000 pixels, which take longer to be shown.
  void start(std::function<void()> on_news);
  /// Reads no further, and calls on_news no more.
  void stop();
  Arrival arrival() const;

 private:
  struct Pixels;
  void read();
  bool take_more();
  void tell(bool ended);

  int file_;
  std::string name_;
  PnmReader reader_;
  std::vector<std::uint8_t> bytes_;  ///< that were read and not taken yet
  std::shared_ptr<Pixels> pixels_;
  std::shared_ptr<const SampleSource> source_;
  std::string damage_;  ///< why what follows is not looked at; "": it is
  std::function<void()> on_news_;
  mutable Mutex mutex_;  ///< guards arrival_
  Arrival arrival_;
  std::atomic<bool> leave_ = false;
  std::optional<JoinedThread> thread_;
};

}  // namespace tyndall
