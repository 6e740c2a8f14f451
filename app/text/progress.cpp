#include "app/text/progress.h"

#include "app/text/standard_streams.h"
#include "core/base/text.h"
#include "core/system/process.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tyndall {

/// Samples a pixel at the end; 0: open.
static std::uint32_t last_spp(const RenderOptions& limits) {
  return limits.spp && *limits.spp < max_samples ? *limits.spp : 0;
}

double progress_fraction(const RenderProgress& now, const RenderOptions& limits, std::uint32_t spp_before) {
  double part = 0;
  if (last_spp(limits) > spp_before && now.spp > spp_before)
    part = static_cast<double>(now.spp - spp_before) / (last_spp(limits) - spp_before);
  if (std::isfinite(limits.time_limit)) part = std::max(part, now.seconds / limits.time_limit);
  if (limits.target_error > 0 && std::isfinite(now.relative_error)) {
    const double ratio = limits.target_error / std::max(now.relative_error, 1e-300);
    part = std::max(part, ratio * ratio);
  }
  return std::min(part, 1.0);
}

std::string duration(double seconds) {
  if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
  if (seconds >= 1e9) return "years";
  const long whole = std::lround(seconds);
  if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
  return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string samples_text(const RenderProgress& now, const RenderOptions& limits) {
  const std::uint32_t last = last_spp(limits);
  return std::to_string(now.spp) + (last > 0 ? "/" + std::to_string(last) : "") + " spp";
}

std::string progress_text(const RenderProgress& now, const RenderOptions& limits, std::uint32_t spp_before) {
  std::string text = samples_text(now, limits);
  if (now.mrays_per_s > 0) text += fmt::format(", {:.3g} Mrays/s", now.mrays_per_s);
  if (std::isfinite(now.relative_error)) text += fmt::format(", error {:.2g}", now.relative_error);
  text += ", " + duration(now.seconds);
  const double part = progress_fraction(now, limits, spp_before);
  if (part > 0) text += ", " + duration(now.seconds * (1 - part) / part) + " left";
  return text;
}

ProgressReport::ProgressReport(ProgressStyle style) {
  if (style == ProgressStyle::none) return;
  form_ = style == ProgressStyle::automatic && has_smart_terminal() ? Form::bar : Form::lines;
  next_ = form_ == Form::bar ? 0.1 : 2;
}

ProgressReport::~ProgressReport() { clear_bar(); }

void ProgressReport::show(double seconds, double part, const std::string& text) {
  if (form_ == Form::none || seconds < next_) return;
  said_ = true;
  next_ = seconds + (form_ == Form::bar ? 0.1 : std::clamp(0.25 * seconds, 2.0, 60.0));
  if (form_ == Form::lines) return complain(text);
  constexpr int text_columns = 60;  // kept free, so that the bar keeps its length
  const int columns = terminal_columns() - 1;
  const int cells = std::clamp(columns - text_columns, 0, 40);
  std::string bar;
  if (cells >= 8) {
    const auto full = static_cast<std::size_t>(std::lround(part * cells));
    const bool colour = !is_set("NO_COLOR");
    bar = "[" + std::string(colour ? "\x1b[36m" : "") + std::string(full, '#') + (colour ? "\x1b[0m" : "") +
          std::string(static_cast<std::size_t>(cells) - full, '.') + "] ";
  }
  std::fprintf(stderr, "\r\x1b[2K%s%s", bar.c_str(),
               printable(text).substr(0, static_cast<std::size_t>(columns)).c_str());
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressReport::clear_bar() {
  if (!drawn_) return;
  std::fputs("\r\x1b[2K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

void ProgressReport::say(const std::string& text) {
  clear_bar();
  complain(text);
}

void ProgressReport::finish(const std::string& summary) {
  clear_bar();
  if (said_) complain(summary);
}

}  // namespace tyndall
