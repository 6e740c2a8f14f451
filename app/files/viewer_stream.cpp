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

/// Appends values to a packet, the lowest byte first.
template <class... Values>
void add(std::string& packet, Values... values) {
  static_assert(std::endian::native == std::endian::little);
  (packet.append(reinterpret_cast<const char*>(&values), sizeof values), ...);
}
/// Texts end with a zero.
void add_text(std::string& packet, const std::string& text) { packet.append(text.c_str(), text.size() + 1); }
void add_channels(std::string& packet) {
  add(packet, static_cast<std::int32_t>(viewer_channel_count));
  for (const char* channel : viewer_channels) add_text(packet, channel);
}
/// The beginning of a packet: room for its size in bytes, its type, and the picture's name.
std::string begin_packet(PacketType type, const std::string& name) {
  std::string packet(sizeof(std::uint32_t), 0);
  add(packet, type, false);  // the viewer need not get the focus
  add_text(packet, name);
  return packet;
}

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
  void send(std::string packet);
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

void ViewerStream::Shared::send(std::string packet) {
  const auto size = static_cast<std::uint32_t>(packet.size());
  std::memcpy(packet.data(), &size, sizeof size);
  for (std::size_t done = 0; done < packet.size();) {
    const Sent sent = send_some(viewer, packet.data(), packet.size(), done);
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
  std::string create = begin_packet(PacketType::create_image, name);
  add(create, width, height);
  add_channels(create);
  send(std::move(create));
}

void ViewerStream::Shared::send_frame(const ViewerFrame& frame) {
  constexpr std::int64_t channels = viewer_channel_count;
  const Region& all = frame.region;
  const std::size_t row_bytes = sizeof(float) * viewer_channel_count * static_cast<std::size_t>(all.width());
  const int band_rows = std::max(1, static_cast<int>(band_bytes / row_bytes));
  const auto* bytes = reinterpret_cast<const char*>(frame.values.data());
  for (int y = all.y0, rows = 0; y < all.y1; y += rows) {
    rows = std::min(band_rows, all.y1 - y);
    std::string packet = begin_packet(PacketType::update_image_v3, name);
    add_channels(packet);
    add(packet, all.x0, y, all.width(), rows);
    for (std::int64_t c = 0; c < channels; ++c) add(packet, c);         // where each channel begins
    for (std::int64_t c = 0; c < channels; ++c) add(packet, channels);  // and how far its values are apart
    packet.append(bytes + row_bytes * static_cast<std::size_t>(y - all.y0), row_bytes * static_cast<std::size_t>(rows));
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
  const auto ended = [&its] { return its.state == State::idle || its.state == State::ended; };
  while (!ended()) {
    const bool connected = its.state == State::sending;
    const auto until = std::min(latest, (connected ? std::max(start, its.taken) : start) + patient);
    if (Clock::now() >= until) {
      its.problem = text_of(its.address) +
                    (connected ? ": the viewer has not taken the last picture" : ": no connection before the end");
      its.stop = true;
      return;
    }
    its.changed.wait_for(lock, std::min<Clock::duration>(until - Clock::now(), look_interval), ended);
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
