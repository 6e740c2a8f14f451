#include "app/window/system/ui_log.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/system/files.h"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <utility>

namespace tyndall {

double quantile(std::vector<double>& values, double q) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double at = std::ceil(q * static_cast<double>(values.size())) - 1;
  return values[static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(values.size() - 1)))];
}

std::string log_name(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

UiLog::UiLog(const std::filesystem::path& file) {
  stream_ = file == "-" ? stdout : open_stream(file, "w");
  if (!stream_) throw IoError(file.string() + ": cannot write: " + std::strerror(errno));
}

UiLog::~UiLog() {
  summary("latency", latencies_);
  summary("latency camera", camera_latencies_);
  summary("latency other", other_latencies_);
  summary("latency clean", clean_latencies_);
  summary("cpu picture", cpu_picture_);
  summary("cpu plain", cpu_plain_);
  if (stream_ != stdout) std::fclose(stream_);
}

void UiLog::line(const std::string& text) {
  resting_ = false;
  std::fprintf(stream_, "%s\n", all_printable(text).c_str());
  std::fflush(stream_);
}

void UiLog::widget(const std::string& name, const Rect& rect, const std::string& value) {
  Widget& known = widgets_[name];
  const bool same = known.drawing != 0 && known.rect == rect && known.value == value;
  known = {rect, value, drawing_};
  if (same) return;
  line("widget " + log_name(name) +
       fmt::format(" {:.0f} {:.0f} {:.0f} {:.0f} ", static_cast<double>(rect.x0), static_cast<double>(rect.y0),
                   static_cast<double>(rect.x1), static_cast<double>(rect.y1)) +
       value);
}

std::optional<Rect> UiLog::find(const std::string& name) const {
  const auto found = widgets_.find(name);
  return found == widgets_.end() ? std::nullopt : std::optional(found->second.rect);
}

void UiLog::end_of_widgets() {
  std::erase_if(widgets_, [this](const auto& widget) {
    const bool gone = widget.second.drawing != drawing_;
    if (gone) line("gone " + log_name(widget.first));
    return gone;
  });
  ++drawing_;
}

void UiLog::submitted(std::uint64_t edit, double since, bool camera_only) {
  if (!submits_.emplace(edit, Submit{since, camera_only}).second) return;
  line("submit " + std::to_string(edit));
}

void UiLog::shown(const Frame& frame, double now) {
  if (frame.pass > 0 && frame.pass == pass_) return;  // drawn again beside another picture
  pass_ = frame.pass;
  const std::uint64_t edit = frame.edit;
  const auto found = submits_.find(edit);
  const bool known = found != submits_.end();
  const double ms = known ? 1e3 * (now - found->second.since) : 0;
  if (edit != shown_) latencies_.push_back(ms);
  if (edit != shown_ && known) (found->second.camera_only ? camera_latencies_ : other_latencies_).push_back(ms);
  shown_ = edit;
  const bool opening = edit == 1;  // that is no edit: the window has just been opened
  if (frame.clean && edit != shown_clean_ && known && !opening) clean_latencies_.push_back(ms);
  if (frame.clean) shown_clean_ = edit;
  if (found != submits_.end()) submits_.erase(submits_.begin(), found);  // older edits will never be shown
  line("frame " + std::to_string(edit) +
       fmt::format(" {} {} {:.1f} {:.1f}", frame.spp, frame.step, ms, frame.first_picture_ms));
}

void UiLog::drawn(double cpu_seconds, bool picture) {
  (picture ? cpu_picture_ : cpu_plain_).push_back(1e3 * cpu_seconds);
  line(fmt::format("drawn {:.2f} {}", 1e3 * cpu_seconds, picture ? 1 : 0));
}

void UiLog::mouse(const Mouse& mouse) {
  const bool somewhere = mouse.x > -1e6f && mouse.y > -1e6f;
  const double x = static_cast<double>(mouse.x), y = static_cast<double>(mouse.y);
  changed("mouse", somewhere ? fmt::format("{:.0f} {:.0f}", x, y) : "none");
  changed("buttons", fmt::format("{:d} {:d} {:d}", mouse.down[0], mouse.down[1], mouse.down[2]));
  changed("keyboard", mouse.typing ? "control" : "shortcuts");
  if (mouse.wheel != 0) line(fmt::format("wheel {:.0f}", mouse.wheel));
}

void UiLog::rest() {
  if (resting_) return;
  line("rest");
  resting_ = true;
}

void UiLog::changed(const std::string& kind, const std::string& value) {
  if (std::exchange(last_[kind], value) != value) line(kind + " " + value);
}

void UiLog::summary(const char* what, std::vector<double> values) {
  const double middle = quantile(values, 0.5), p95 = quantile(values, 0.95), p99 = quantile(values, 0.99);
  line(std::string(what) + fmt::format(" n {} p50 {:.1f} p95 {:.1f} p99 {:.1f} max {:.1f} ms", values.size(), middle,
                                       p95, p99, quantile(values, 1)));
}

}  // namespace tyndall
