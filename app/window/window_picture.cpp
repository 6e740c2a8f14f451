#include "app/text/numbers.h"
#include "app/window/main_window.h"
#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

/// The pictures of MainWindow: which are on the screen, and how.
namespace tyndall {
namespace {

/// "mis · sobol   1,024 spp   1.2 %".
std::string half_text(const std::string& method, const Frame* frame, const Convergence& curves, bool is_true) {
  if (!frame || frame->spp == 0) return method;
  std::string text = method + "   " + format_count(frame->spp) + " spp";
  const ConvergenceRun& run = curves.current();
  if (run.edit != frame->edit || run.points.empty()) return text;
  char error[64];
  std::snprintf(error, sizeof error, "   %s error %.2g %%", is_true ? "true" : "est.",
                100 * std::sqrt(run.points.back().rel_mse));
  return text + error;
}

}  // namespace

void MainWindow::take_pictures() {
  if (const auto latest = session_.latest(); latest && latest != shown_) session_.shown(Half::current, shown_ = latest);
  if (const auto kept = session_.latest_kept(); kept && kept != shown_kept_)
    session_.shown(Half::kept, shown_kept_ = kept);
}

bool MainWindow::shows_halves() const { return session_.split() && !session_.accuracy().map(); }

void MainWindow::draw_halves(const Layout& layout) {
  if (!shows_halves()) return;
  const LiveAccuracy& accuracy = session_.accuracy();
  const auto text = [&](Half half, const Frame* frame) {
    return half_text(session_.method(half), frame, accuracy.curves(half), accuracy.is_true());
  };
  if (log_ && shown_ && shown_kept_) {
    char seconds[64];
    std::snprintf(seconds, sizeof seconds, "A %.2f B %.2f", shown_kept_->seconds, shown_->seconds);
    log_->changed("halves", seconds);
  }
  draw_split(ui_, layout.image, divider_, {text(Half::kept, shown_kept_.get()), text(Half::current, shown_.get())});
}

void MainWindow::upload_pictures() {
  if (!session_.split()) left_display_.reset(), shown_kept_.reset(), uploaded_left_.reset();
  const auto map = session_.accuracy().map();
  if (map && map != uploaded_) display_.upload(map->width, map->height, map->rgba);
  if (!map && shown_ && shown_ != uploaded_) display_.upload(shown_->width, shown_->height, shown_->rgba);
  uploaded_ = map ? std::shared_ptr<const void>(map) : shown_;
  if (!shows_halves() || !shown_kept_ || shown_kept_ == uploaded_left_) return;
  if (!left_display_) left_display_ = std::make_unique<FrameDisplay>();
  left_display_->upload(shown_kept_->width, shown_kept_->height, shown_kept_->rgba);
  uploaded_left_ = shown_kept_;
}

void MainWindow::show_picture(const Layout& layout) {
  try {
    upload_pictures();
  } catch (const IoError& error) {
    session_.say(error.what(), true);
  }
  platform_.clear();
  const float dots =
      static_cast<float>(platform_.framebuffer_width()) / static_cast<float>(std::max(1, platform_.width()));
  const auto in_dots = [dots](const Rect& r) { return Rect{r.x0 * dots, r.y0 * dots, r.x1 * dots, r.y1 * dots}; };
  const Rect whole = in_dots(layout.image);
  const int height = platform_.framebuffer_height();
  const Display& display = session_.scene().display;
  const auto look = [&](const Frame* frame) {
    const bool plain = session_.accuracy().map() || (frame && frame->view != View::beauty);
    return plain ? Look{} : Look{display.exposure, display.tone_map};
  };
  display_.draw(whole, height, look(shown_.get()), whole);
  if (shows_halves() && left_display_) {
    Rect left = whole;
    left.x1 = std::round(divider_.x(layout.image)) * dots;
    left_display_->draw(whole, height, look(shown_kept_.get()), left);
  }
  platform_.end_frame();
}

}  // namespace tyndall
