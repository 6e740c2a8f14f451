#pragma once
#include "core/film/film.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Streams a picture to a viewer that speaks the protocol of tev (T. Müller, https://github.com/Tom94/tev,
/// src/Ipc.cpp): packets over TCP, of which CreateImage (4) and UpdateImageV3 (6) are sent.
namespace tyndall {

/// Where a viewer listens.
struct ViewerAddress {
  std::string host, port;
};
inline constexpr const char* usual_viewer_port = "14158";

/// Reads "HOST" or "HOST:PORT"; an IPv6 address with a port stands in brackets: "[::1]:14158". Throws UsageError.
ViewerAddress read_viewer_address(const std::string& text);
/// "localhost:14158", "[::1]:14158".
std::string text_of(const ViewerAddress& address);

/// Channels of the streamed picture: the mean, its estimated relative error, and the clean view, which is black as long
/// as there is none.
inline constexpr const char* viewer_channels[] = {"R", "G", "B", "error", "clean.R", "clean.G", "clean.B"};
inline constexpr std::size_t viewer_channel_count = 7;

/// What is sent of a picture: rows of the region, the channels of each pixel together.
struct ViewerFrame {
  Region region;
  std::vector<float> values;
};

/// A connection to a viewer. The name of its host is looked up, the connection made and everything sent on threads of
/// their own; no function waits for the viewer unless it says so. A viewer that fails changes nothing but problem();
/// nothing is tried again then.
class ViewerStream {
 public:
  /// name: what the viewer calls the picture; width, height: of the whole.
  ViewerStream(const ViewerAddress& address, const std::string& name, int width, int height);
  ~ViewerStream();  ///< gives up what is not sent yet
  ViewerStream(const ViewerStream&) = delete;
  ViewerStream& operator=(const ViewerStream&) = delete;

  /// Whether the viewer is there and has taken all that was sent. What it sends is thrown away; that it has closed the
  /// connection shows there.
  bool ready() const;
  /// Sends a frame in the background; only if ready().
  void send(ViewerFrame frame);
  /// Waits until the viewer has taken all that was sent: as long as it goes on taking, 5 s at most; but only `patience`
  /// seconds for a viewer that takes nothing or is not connected yet.
  void finish(double patience);
  /// What went wrong, once: "localhost:14158: Connection refused".
  std::optional<std::string> problem();

 private:
  struct Shared;
  void start(std::function<void(Shared&)> work);

  std::shared_ptr<Shared> shared_;  ///< threads have it, too, as a look-up of a name cannot be stopped
};

}  // namespace tyndall
