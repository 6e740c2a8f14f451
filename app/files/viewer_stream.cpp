#include "app/files/viewer_stream.h"

#include "core/base/error.h"
#include "core/base/seconds.h"
#include "core/base/text.h"
#include "core/system/connection.h"
#include "core/system/locks.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <thread>
#include <utility>

namespace tyndall {
namespace {

using namespace std::chrono_literals;

constexpr auto look_interval = 50ms;          // how often a waiting thread looks whether it is to stop
constexpr auto silence = 10s;                 // after which a viewer that takes nothing is given up
constexpr auto longest_finish = 5s;           // for a viewer that goes on taking
constexpr std::size_t band_bytes = 1u << 20;  // of a packet, about

enum class PacketType : char { create_image = 4, update_image_v3 = 6 };

/// A packet: its size in bytes (4 bytes), its type, and values, the lowest byte first; texts end with a zero.
class Packet {
 public:
  explicit Packet(PacketType type) : bytes_(4) { bytes_.push_back(static_cast<char>(type)); }
  template <class Number>
  void add(Number number) {
    static_assert(std::endian::native == std::endian::little);
    const auto* data = reinterpret_cast<const char*>(&number);
    bytes_.insert(bytes_.end(), data, data + sizeof number);
  }
  void add(bool value) { bytes_.push_back(value ? 1 : 0); }
  void add(const std::string& text) { bytes_.insert(bytes_.end(), text.c_str(), text.c_str() + text.size() + 1); }
  void add(const float* values, std::size_t count) {
    const auto* data = reinterpret_cast<const char*>(values);
    bytes_.insert(bytes_.end(), data, data + count * sizeof(float));
  }
  const std::vector<char>& finished() {
    const auto size = static_cast<std::uint32_t>(bytes_.size());
    std::memcpy(bytes_.data(), &size, sizeof size);
    return bytes_;
  }

 private:
  std::vector<char> bytes_;
};

Packet create_packet(const std::string& name, int width, int height) {
  Packet packet(PacketType::create_image);
  packet.add(false);  // do not take the focus
  packet.add(name);
  packet.add(std::int32_t{width}), packet.add(std::int32_t{height});
  packet.add(static_cast<std::int32_t>(viewer_channel_count));
  for (const char* channel : viewer_channels) packet.add(std::string(channel));
  return packet;
}

/// The rows y0 <= y < y1 of a frame.
Packet update_packet(const std::string& name, const ViewerFrame& frame, int y0, int y1) {
  Packet packet(PacketType::update_image_v3);
  packet.add(false);
  packet.add(name);
  packet.add(static_cast<std::int32_t>(viewer_channel_count));
  for (const char* channel : viewer_channels) packet.add(std::string(channel));
  for (const int number : {frame.region.x0, y0, frame.region.width(), y1 - y0}) packet.add(std::int32_t{number});
  for (std::size_t c = 0; c < viewer_channel_count; ++c) packet.add(static_cast<std::int64_t>(c));  // offsets
  for (std::size_t c = 0; c < viewer_channel_count; ++c)
    packet.add(static_cast<std::int64_t>(viewer_channel_count));  // strides
  const std::size_t row = viewer_channel_count * static_cast<std::size_t>(frame.region.width());
  packet.add(frame.values.data() + row * static_cast<std::size_t>(y0 - frame.region.y0),
             row * static_cast<std::size_t>(y1 - y0));
  return packet;
}

}  // namespace

/// What the caller and the thread both see, and what the thread does.
struct ViewerStream::Shared {
  ViewerAddress address;
  std::string name;
  int width = 0, height = 0;

  mutable Mutex mutex;
  Condition changed;
  // Guarded by the mutex:
  std::optional<ViewerFrame> frame;
  bool connected = false, sending = false, stop = false, ended = false;
  Clock::time_point taken = Clock::now();  ///< when the viewer last took something
  std::string problem;

  void run();
  void serve(const Connection& viewer);
  bool send_frame(const Connection& viewer, const ViewerFrame& what);
  bool send_all(const Connection& viewer, const std::vector<char>& bytes);
  bool may_go_on(Connection::Sent sent);
  bool stopped() const {
    const std::lock_guard lock(mutex);
    return stop;
  }
  void fail(const std::string& why) {
    const std::lock_guard lock(mutex);
    if (!stop && problem.empty()) problem = text_of(address) + ": " + why;
  }
};

/// Whether to send further.
bool ViewerStream::Shared::may_go_on(Connection::Sent sent) {
  const std::lock_guard lock(mutex);
  if (sent == Connection::Sent::some) taken = Clock::now();
  if (stop) return false;
  if (sent == Connection::Sent::closed)
    problem = text_of(address) + ": the viewer has closed the connection";
  else if (Clock::now() - taken > silence)
    problem = text_of(address) + ": the viewer has taken nothing for 10 s";
  return problem.empty();
}

bool ViewerStream::Shared::send_all(const Connection& viewer, const std::vector<char>& bytes) {
  for (std::size_t done = 0; done < bytes.size();)
    if (!may_go_on(viewer.send(bytes.data(), bytes.size(), done))) return false;
  return true;
}

bool ViewerStream::Shared::send_frame(const Connection& viewer, const ViewerFrame& what) {
  const auto row_bytes = viewer_channel_count * sizeof(float) * static_cast<std::size_t>(what.region.width());
  const int rows = std::max(1, static_cast<int>(band_bytes / row_bytes));
  for (int y = what.region.y0; y < what.region.y1; y += rows)
    if (!send_all(viewer, update_packet(name, what, y, std::min(y + rows, what.region.y1)).finished())) return false;
  return true;
}

/// Sends frame after frame. Whatever the viewer sends is thrown away; that it has closed the connection shows there.
void ViewerStream::Shared::serve(const Connection& viewer) {
  if (!send_all(viewer, create_packet(name, width, height).finished())) return;
  for (;;) {
    std::optional<ViewerFrame> next;
    {
      std::unique_lock lock(mutex);
      sending = false;
      changed.notify_all();
      changed.wait_for(lock, look_interval, [&] { return stop || frame; });
      if (stop) return;
      next = std::exchange(frame, {});
      sending = next.has_value();
      if (sending) taken = Clock::now();
    }
    if (viewer.is_closed_by_other()) return fail("the viewer has closed the connection");
    if (next && !send_frame(viewer, *next)) return;
  }
}

void ViewerStream::Shared::run() {
  std::string why;
  if (const auto viewer = Connection::to(
          address.host, address.port, [this] { return !stopped(); }, why)) {
    {
      const std::lock_guard lock(mutex);
      connected = sending = true, taken = Clock::now();
    }
    serve(*viewer);
  } else if (!why.empty()) {
    fail(why);
  }
  const std::lock_guard lock(mutex);
  connected = sending = false, ended = true;
  changed.notify_all();
}

ViewerStream::ViewerStream(const ViewerAddress& address, const std::string& name, int width, int height)
    : shared_(std::make_shared<Shared>()) {
  shared_->address = address, shared_->name = all_printable(name), shared_->width = width, shared_->height = height;
  try {
    std::thread([shared = shared_] {
      try {
        shared->run();
      } catch (const std::exception& error) {
        shared->fail(error.what());
      }
    }).detach();
  } catch (const std::exception& error) {
    shared_->problem = text_of(address) + ": " + error.what();
    shared_->ended = true;
  }
}

ViewerStream::~ViewerStream() {
  const std::lock_guard lock(shared_->mutex);
  shared_->stop = true;
  shared_->changed.notify_all();
}

bool ViewerStream::ready() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->connected && !shared_->sending && !shared_->frame;
}

void ViewerStream::send(ViewerFrame frame) {
  const std::lock_guard lock(shared_->mutex);
  shared_->frame = std::move(frame);
  shared_->changed.notify_all();
}

void ViewerStream::finish(double patience) {
  const auto start = Clock::now(), latest = start + longest_finish;
  const auto patient = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(patience));
  std::unique_lock lock(shared_->mutex);
  for (;;) {
    const bool done = shared_->ended || (shared_->connected && !shared_->sending && !shared_->frame);
    if (done) return;
    const auto until = std::min(latest, (shared_->connected ? std::max(start, shared_->taken) : start) + patient);
    if (Clock::now() >= until) break;
    shared_->changed.wait_until(lock, std::min(until, Clock::now() + look_interval));
  }
  if (shared_->problem.empty())
    shared_->problem = text_of(shared_->address) + (shared_->connected ? ": the viewer has not taken the last picture"
                                                                       : ": no connection before the end");
  shared_->stop = true;
}

std::optional<std::string> ViewerStream::problem() {
  const std::lock_guard lock(shared_->mutex);
  if (shared_->problem.empty()) return {};
  return std::exchange(shared_->problem, {});
}

ViewerAddress read_viewer_address(const std::string& text) {
  const auto refuse = [&text] {
    throw UsageError("found " + in_quotes(printable(text)) + ", expected HOST or HOST:PORT, such as localhost:" +
                     usual_viewer_port + " or [::1]:" + usual_viewer_port);
  };
  ViewerAddress address{text, usual_viewer_port};
  const std::size_t colon = text.rfind(':'), closing = text.find(']');
  std::optional<std::string> port;
  if (!text.empty() && text[0] == '[') {
    if (closing == text.npos || (closing + 1 < text.size() && text[closing + 1] != ':')) refuse();
    address.host = text.substr(1, closing - 1);
    if (closing + 1 < text.size()) port = text.substr(closing + 2);
  } else if (colon != text.npos && text.find(':') == colon) {  // with more of them it is an IPv6 address
    address.host = text.substr(0, colon), port = text.substr(colon + 1);
  }
  if (port) {
    double number = 0;
    const bool digits = !port->empty() && port->find_first_not_of("0123456789") == port->npos;
    if (!digits || !number_from_text(*port, number) || number < 1 || number > 65535) refuse();
    address.port = *port;
  }
  if (address.host.empty() || address.host.find('\0') != address.host.npos) refuse();
  return address;
}

std::string text_of(const ViewerAddress& address) {
  const bool six = address.host.find(':') != address.host.npos;
  return (six ? "[" + address.host + "]" : address.host) + ":" + address.port;
}

}  // namespace tyndall
