#include "app/files/arriving_picture.h"

#include "core/base/error.h"
#include "core/base/seconds.h"
#include "core/base/text.h"
#include "core/image/image_io_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <exception>
#include <span>

namespace tyndall {
namespace {

constexpr std::size_t piece = 65536;  // bytes; as many as a pipe of Linux holds

/// How many bytes were read, up to `size`; 0: there are no more.
std::size_t read_bytes(int file, std::uint8_t* to, std::size_t size) {
  std::size_t got = 0;
  if (const int problem = read_some(file, to, size, got); problem != 0)
    throw IoError("standard input: cannot read: " + error_text(problem));
  return got;
}

}  // namespace

Beginning beginning_of(int file) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  Beginning found;
  for (std::uint8_t byte = 0; read_bytes(file, &byte, 1) == 1;) {
    found.bytes += static_cast<char>(byte);
    std::string_view rest = found.bytes;
    if (mark.starts_with(rest)) continue;
    if (rest.starts_with(mark)) rest.remove_prefix(mark.size());
    while (!rest.empty() && is_space(rest.front())) rest.remove_prefix(1);
    if (rest.empty() || rest == "/" || found.bytes == "P") continue;
    found.is_scene = rest == "{" || rest == "//" || rest == "/*";
    found.is_picture = found.bytes[0] == 'P' && byte >= '0' && byte <= '9';
    return found;
  }
  found.is_scene = std::all_of(found.bytes.begin(), found.bytes.end(), is_space);
  return found;
}

std::string first_line_of(int file, std::string begin) {
  constexpr int patience = 100;  // milliseconds: the program may not have written the rest of its line yet
  begin.erase(0, begin.find_first_not_of(" \t\r\n\v\f"));
  while (begin.size() < piece && begin.find('\n') == begin.npos && has_bytes(file, patience)) {
    std::array<std::uint8_t, piece> more{};
    const std::size_t got = read_bytes(file, more.data(), more.size());
    if (got == 0) break;
    begin.append(more.begin(), more.begin() + static_cast<std::ptrdiff_t>(got));
  }
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(begin.data()), begin.size());
  if (image_kind(bytes) != ImageKind::unknown && begin[0] != 'P') return "a picture of another kind";
  if (begin.starts_with("\xff\xfe") || begin.starts_with("\xfe\xff")) return "text in UTF-16";
  if (begin.starts_with("\xef\xbb\xbf")) return "a byte order mark";
  return in_quotes(printable(shortened(begin.substr(0, begin.find_first_of("\r\n")), 60)));
}

/// Written by the thread that reads, and read by those that render: only what has arrived.
struct ArrivingPicture::Pixels {
  std::size_t width = 0, height = 0;
  std::vector<float> rgb{};              ///< with room for all, so that none is moved
  std::atomic<std::size_t> arrived = 0;  ///< whole pixels

  Vec3f at(double x, double y) const {
    const std::size_t pixel = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
    if (pixel >= arrived.load(std::memory_order_acquire)) return {};
    const float* light = rgb.data() + 3 * pixel;
    return {light[0], light[1], light[2]};
  }
};

ArrivingPicture::ArrivingPicture(int file, const std::string& begin, const std::string& name, PpmCurve curve)
    : file_(file), name_(name), reader_(name, curve), bytes_(begin.begin(), begin.end()), pixels_(new Pixels) {
  try {
    for (std::size_t got = 1; got > 0 && !reader_.header();) {
      const std::size_t taken = reader_.take(bytes_, pixels_->rgb, true);
      bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(taken));
      if (reader_.header()) break;
      bytes_.resize(piece);
      bytes_.resize(got = read_bytes(file_, bytes_.data(), piece));
    }
    if (!reader_.header()) reader_.end(pixels_->rgb);
  } catch (const ImageFileError& error) {
    throw UsageError(error.what());
  }
  if (!reader_.header()) throw UsageError(name + ": ended where " + reader_.expected() + " of a picture is expected");
  pixels_->width = static_cast<std::size_t>(width()), pixels_->height = static_cast<std::size_t>(height());
  source_ = std::make_shared<const SampleSource>(
      SampleSource{[pixels = pixels_](double x, double y, std::uint64_t) { return pixels->at(x, y); }});
}

void ArrivingPicture::start(std::function<void()> on_news) {
  pixels_->rgb.reserve(3 * pixels_->width * pixels_->height);
  on_news_ = std::move(on_news);
  thread_.emplace([this] { read(); });
}

void ArrivingPicture::stop() {
  leave_ = true;
  thread_.reset();
}

Arrival ArrivingPicture::arrival() const {
  const std::lock_guard lock(mutex_);
  return arrival_;
}

void ArrivingPicture::read() {
  // To show a pixel takes some 0.07 µs, so that this leaves the program three quarters of a core at the least.
  const double period = std::max(0.1, 3e-7 * static_cast<double>(pixels_->width * pixels_->height));
  if (!bytes_.empty()) take_more();
  tell(false);
  Clock::time_point told = Clock::now();
  for (bool news = false; !leave_;) {
    if (has_bytes(file_, 50)) {
      if (!take_more()) return tell(true);
      news = true;
    }
    if (news && seconds_since(told) >= period) tell(false), told = Clock::now(), news = false;
  }
}

/// Takes what was read with the header, or else what comes, and shows it to the renderers. False: no more will come.
bool ArrivingPicture::take_more() {
  std::vector<float>& light = pixels_->rgb;
  std::size_t got = bytes_.size();
  try {
    if (got == 0) {
      bytes_.resize(piece);
      got = read_bytes(file_, bytes_.data(), piece);
    }
    const auto bytes = std::span(bytes_).first(damage_.empty() ? got : 0);
    const auto behind = bytes.subspan(reader_.take(bytes, light));
    const auto is_seen = [](std::uint8_t byte) { return !is_space(static_cast<char>(byte)); };
    if (std::any_of(behind.begin(), behind.end(), is_seen))
      damage_ = name_ + ": what follows the last pixel is not shown";
    if (got == 0 && damage_.empty()) reader_.end(light);
  } catch (const std::exception& error) {
    damage_ = error.what();
  }
  bytes_.clear();
  pixels_->arrived.store(light.size() / 3, std::memory_order_release);
  return got > 0;
}

/// Says how much has come, if that is news. ended: no more will.
void ArrivingPicture::tell(bool ended) {
  Arrival now;
  now.rows = static_cast<int>(pixels_->arrived / pixels_->width);
  now.ended = ended || !damage_.empty() || reader_.whole();
  if (now.ended) {
    std::vector<std::string> said;
    if (!damage_.empty()) said.push_back(damage_);
    if (!reader_.whole()) said.push_back(fmt::format("ended at row {} of {}", now.rows, height()));
    if (const auto remark = reader_.remark()) said.push_back(*remark);
    now.said = joined(said, "; ");
  }
  std::unique_lock lock(mutex_);
  if (now == std::exchange(arrival_, now)) return;
  lock.unlock();
  on_news_();
}

}  // namespace tyndall
