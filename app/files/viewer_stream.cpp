#include "app/files/viewer_stream.h"

#include "core/base/error.h"
#include "core/base/seconds.h"
#include "core/base/text.h"
#include "core/system/connection.h"
#include "core/system/locks.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <mutex>
#include <thread>
#include <utility>

namespace tyndall {
namespace {

using namespace std::chrono_literals;

constexpr auto look_interval = 50ms;          // how often it is looked how the viewer takes a picture
constexpr auto silence = 10s;                 // after which a viewer that takes nothing is given up
constexpr auto longest_finish = 5s;           // for a viewer that goes on taking
constexpr std::size_t band_bytes = 1u << 20;  // of a packet, about
constexpr const char* closed = "the viewer has closed the connection";

enum class PacketType : char { create_image = 4, update_image_v3 = 6 };

/// A packet: its size in bytes (4 bytes), its type, and values, the lowest byte first; texts end with a zero.
class Packet {
 public:
  Packet(PacketType type, const std::string& name) : bytes_(4, '\0') {
    add(type, false);  // the viewer need not get the focus
    add_text(name);
  }
  template <class... Values>
  void add(Values... values) {
    static_assert(std::endian::native == std::endian::little);
    (bytes_.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
  }
  void add_text(const std::string& text) { bytes_.append(text.c_str(), text.size() + 1); }
  void add_channels() {
    add(static_cast<std::int32_t>(viewer_channel_count));
    for (const char* channel : viewer_channels) add_text(channel);
  }
  /// The rows y0 <= y < y1 of a frame.
  void add_rows(const ViewerFrame& frame, int y0, int y1) {
    constexpr std::int64_t channels = viewer_channel_count;
    add(frame.region.x0, y0, frame.region.width(), y1 - y0);
    for (std::int64_t c = 0; c < channels; ++c) add(c);         // where each channel begins
    for (std::int64_t c = 0; c < channels; ++c) add(channels);  // and how far its values are apart
    const std::int64_t row = channels * frame.region.width();
    bytes_.append(reinterpret_cast<const char*>(frame.values.data() + row * (y0 - frame.region.y0)),
                  sizeof(float) * static_cast<std::size_t>(row * (y1 - y0)));
  }
  const std::string& finished() {
    const auto size = static_cast<std::uint32_t>(bytes_.size());
    std::memcpy(bytes_.data(), &size, sizeof size);
    return bytes_;
  }

 private:
  std::string bytes_;
};

}  // namespace

/// What the caller and the threads both see. One thread at a time uses the connection.
struct ViewerStream::Shared {
  ViewerAddress address;
  std::string name;
  int width = 0, height = 0;

  mutable Mutex mutex;
  Condition changed;
  OpenFile viewer{};
  // Guarded by the mutex:
  enum class State { connecting, idle, sending, ended } state = State::connecting;
  bool stop = false;
  Clock::time_point taken = Clock::now();  ///< when the viewer last took something
  std::string problem{};

  // These throw an IoError where the viewer fails, or the caller has asked for the end.
  void connect();
  void send(Packet packet);
  void send_frame(const ViewerFrame& frame);

  /// The end, of which the caller is told unless it has asked for it.
  void fail(const std::string& why) {
    const std::lock_guard lock(mutex);
    if (!stop) problem = text_of(address) + ": " + why;
    state = State::ended;
    changed.notify_all();
  }
  void set(State now) {
    const std::lock_guard lock(mutex);
    state = now, taken = Clock::now();
    changed.notify_all();
  }
};

void ViewerStream::Shared::send(Packet packet) {
  const std::string& bytes = packet.finished();
  for (std::size_t done = 0; done < bytes.size();) {
    const Sent sent = send_some(viewer, bytes.data(), bytes.size(), done);
    const std::lock_guard lock(mutex);
    if (sent == Sent::closed) throw IoError(closed);
    if (sent == Sent::some) taken = Clock::now();
    if (stop || Clock::now() - taken > silence) throw IoError("the viewer has taken nothing for 10 s");
  }
}

void ViewerStream::Shared::connect() {
  std::string why;
  const auto waits = [this] {
    const std::lock_guard lock(mutex);
    return !stop;
  };
  viewer = connect_to(address.host, address.port, waits, why);
  if (!viewer) throw IoError(why);
  set(State::sending);
  Packet create(PacketType::create_image, name);
  create.add(width, height);
  create.add_channels();
  send(std::move(create));
}

void ViewerStream::Shared::send_frame(const ViewerFrame& frame) {
  const auto row_bytes = viewer_channel_count * sizeof(float) * static_cast<std::size_t>(frame.region.width());
  const int rows = std::max(1, static_cast<int>(band_bytes / row_bytes));
  for (int y = frame.region.y0; y < frame.region.y1; y += rows) {
    Packet packet(PacketType::update_image_v3, name);
    packet.add_channels();
    packet.add_rows(frame, y, std::min(y + rows, frame.region.y1));
    send(std::move(packet));
  }
}

/// Does a piece of work on a thread that nobody waits for.
void ViewerStream::start(std::function<void(Shared&)> work) {
  try {
    std::thread([shared = shared_, work = std::move(work)] {
      try {
        work(*shared);
        shared->set(Shared::State::idle);
      } catch (const std::exception& error) {
        shared->fail(error.what());
      }
    }).detach();
  } catch (const std::exception& error) {
    shared_->fail(error.what());
  }
}

ViewerStream::ViewerStream(const ViewerAddress& address, const std::string& name, int width, int height)
    : shared_(new Shared{address, all_printable(name), width, height, {}, {}}) {
  start([](Shared& its) { its.connect(); });
}

ViewerStream::~ViewerStream() {
  const std::lock_guard lock(shared_->mutex);
  shared_->stop = true;
}

bool ViewerStream::ready() const {
  {
    const std::lock_guard lock(shared_->mutex);
    if (shared_->state != Shared::State::idle) return false;
  }
  const bool gone = is_closed_by_other(shared_->viewer);
  if (gone) shared_->fail(closed);
  return !gone;
}

void ViewerStream::send(ViewerFrame frame) {
  shared_->set(Shared::State::sending);
  start([frame = std::move(frame)](Shared& its) { its.send_frame(frame); });
}

void ViewerStream::finish(double patience) {
  using State = Shared::State;
  Shared& its = *shared_;
  const auto start = Clock::now(), latest = start + longest_finish;
  const auto patient = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(patience));
  std::unique_lock lock(its.mutex);
  while (its.state == State::connecting || its.state == State::sending) {
    const bool connected = its.state == State::sending;
    const auto until = std::min(latest, (connected ? std::max(start, its.taken) : start) + patient);
    if (Clock::now() >= until) {
      its.problem = text_of(its.address) +
                    (connected ? ": the viewer has not taken the last picture" : ": no connection before the end");
      its.stop = true;
      return;
    }
    its.changed.wait_until(lock, std::min(until, Clock::now() + look_interval));
  }
}

std::optional<std::string> ViewerStream::problem() {
  const std::lock_guard lock(shared_->mutex);
  if (shared_->problem.empty()) return {};
  return std::exchange(shared_->problem, {});
}

ViewerAddress read_viewer_address(const std::string& text) {
  const std::size_t bracket = text.starts_with('[') ? 1 : 0;
  const bool is_whole = bracket == 0 && text.find(':') != text.rfind(':');  // an IPv6 address without a port
  const std::size_t end = is_whole ? text.size() : std::min(text.size(), text.find(bracket > 0 ? ']' : ':'));
  ViewerAddress address{text.substr(bracket, end - bracket), usual_viewer_port};
  const std::string rest = text.substr(std::min(end + bracket, text.size()));
  if (!rest.empty()) address.port = rest.substr(1);
  double port = 0;
  const bool right = (rest.empty() || rest[0] == ':') && (bracket == 0 || end < text.size()) &&
                     address.port.find_first_not_of("0123456789") == rest.npos &&
                     number_from_text(address.port, port) && port >= 1 && port <= 65535;
  if (!right || address.host.empty() || address.host.find('\0') != rest.npos)
    throw UsageError("found " + in_quotes(printable(text)) + ", expected HOST or HOST:PORT, such as localhost:" +
                     usual_viewer_port + " or [::1]:" + usual_viewer_port);
  return address;
}

std::string text_of(const ViewerAddress& address) {
  const bool six = address.host.find(':') != address.host.npos;
  return (six ? "[" + address.host + "]" : address.host) + ":" + address.port;
}

}  // namespace tyndall
