#include "app/window/main_window.h"

#include "app/window/document/open_document.h"
#include "app/window/system/clock.h"
#include "app/window/system/display_lost.h"
#include "app/window/tools/camera_control.h"
#include "core/base/error.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace tyndall {
namespace {

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

std::unique_ptr<UiLog> open_log(const std::filesystem::path& file) {
  return file.empty() ? nullptr : std::make_unique<UiLog>(file);
}

}  // namespace

MainWindow::MainWindow(const WindowOptions& options, std::shared_ptr<const Reference> reference)
    : log_(open_log(options.ui_log)),
      platform_(options.scene.scene.width, options.scene.scene.height),
      session_(
          options, [] { Platform::wake(); },
          [this] {
            if (clock_seconds() >= due_ && !posted_.exchange(true)) Platform::wake();
          },
          log_.get()),
      scenes_(built_in_scenes()) {
  ui_.log = log_.get();
  panels_.scenes = &scenes_;
  panels_.accuracy = &session_.accuracy();
  if (reference) session_.set_reference(std::move(reference));
}

void MainWindow::run() {
  while (!platform_.closing()) {
    platform_.wait(waiting_time(clock_seconds()));
    posted_ = false;
    const InputEvents events = platform_.take_events();
    if (events.any || session_.collect()) pacing_.on_event();
    take_input(events);
    const double now = clock_seconds();
    if (session_.collect_errors()) pacing_.wake_at(now);
    session_.send(now);
    if (session_.edit_number() != paced_edit_) pacing_.on_edit(paced_edit_ = session_.edit_number(), now);
    if (pacing_.wait(now) <= 0 || picture_due(now)) draw(now);
  }
  platform_.hide();  // a comparison or a snapshot may still take a second
}

/// A frame that is not on the screen, the last one of a render if there is one; null: there is none.
std::shared_ptr<const Frame> MainWindow::unseen() const {
  const auto latest = session_.latest(), kept = session_.latest_kept();
  const bool new_kept = kept && kept != shown_kept_;
  if (latest && latest != shown_ && (latest->finished || !new_kept)) return latest;
  return new_kept ? kept : nullptr;
}

bool MainWindow::picture_due(double now) const {
  const auto frame = unseen();
  if (!frame || now < pacing_.next_drawing()) return false;
  return now >= pacing_.picture_due() || frame->finished;
}

bool MainWindow::hidden() const { return platform_.framebuffer_width() <= 0 || platform_.framebuffer_height() <= 0; }

double MainWindow::waiting_time(double now) {
  const double sends = std::max(0.0, session_.send_time() - now);
  if (hidden()) {  // nothing to draw until an event shows the window again
    due_ = std::numeric_limits<double>::infinity();
    return sends;
  }
  // The order matters: from here on a frame that comes after its time wakes the window, one that came is seen below,
  // and one that comes between is seen when its time has come.
  const double due = std::max(pacing_.picture_due(), pacing_.next_drawing());
  due_ = due;
  const auto frame = unseen();
  double wait = pacing_.wait(now);
  if (frame)
    wait = std::min(wait, std::max(0.0, (frame->finished ? pacing_.next_drawing() : due) - now));
  else if (due > now)
    wait = std::min(wait, due - now);
  return std::min(wait, sends);
}

void MainWindow::update_scale() {
  const float pixels = platform_.pixels(), scale = platform_.scale();
  if (pixels == pixels_ && scale == ui_.scale) return;
  set_style(scale);
  ui_.fonts = load_fonts(pixels, scale);
  if (pixels_ != 0) platform_.renew_fonts();
  pixels_ = pixels;
  ui_.scale = scale;
}

void MainWindow::draw(double now) {
  const double cpu_before = thread_cpu_seconds();
  pacing_.on_drawing();
  if (hidden()) return pacing_.on_drawn(now);
  update_scale();
  platform_.begin_frame();
  ui_.wake_in = 1e300;
  ui_.problem.clear();
  count_gestures(now);
  const bool fresh = picture_due(now);
  if (fresh) take_pictures();
  // The old picture keeps its shape until the new one is there.
  const Scene& scene = session_.scene();
  const Layout layout =
      make_layout(static_cast<float>(platform_.width()), static_cast<float>(platform_.height()),
                  shown_ ? shown_->width : scene.width, shown_ ? shown_->height : scene.height, ui_.scale, columns_);
  draw_interface(layout);
  pointer(layout, now);
  fly(now);
  apply_panels(now);
  show_picture(layout);
  finish_drawing(now, cpu_before, fresh);
}

void MainWindow::draw_interface(const Layout& layout) {
  panels_.scene = session_.scene();
  panels_.frame = shown_;
  panels_.title = session_.document().origin->title;
  panels_.paused = session_.paused();
  panels_.threads = session_.threads();
  panels_.kept_method = session_.split() ? session_.method(Half::kept) : "";
  panels_.can_show_errors = session_.can_show_errors();
  panels_.wishes = {};
  ui_.size = target_distance(panels_.scene.camera);
  if (!find_object(panels_.scene, panels_.selected)) panels_.selected.clear();
  draw_column(ui_, panels_, layout.column);
  draw_outline(ui_, layout.image, outline(panels_.scene, panels_.selected));
  draw_halves(layout);
  draw_status(ui_, layout.status,
              status_cells(shown_.get(), session_.accuracy().curves(Half::current).current(), session_.document(),
                           {session_.paused(), session_.accuracy().is_true(), session_.split()}));
  draw_message(ui_, layout.area, session_.message());
  if (help_) draw_help(ui_, layout.area, help_);
  const ReferenceWish reference =
      draw_reference_dialog(ui_, layout.area, dialog_, session_.accuracy().reference() != nullptr);
  if (reference.file) session_.open_reference(*reference.file);
  if (reference.keep) session_.keep_as_reference();
  if (reference.drop) session_.drop_reference();
  if (const auto file = draw_dialog(ui_, layout.area, dialog_, session_.document())) session_.save(*file);
  if (ui_.log) {
    ui_.log->widget("picture", layout.image, title_of(panels_.scene, panels_.selected));
    ui_.log->end_of_widgets();
  }
}

void MainWindow::apply_panels(double now) {
  session_.edit(panels_.scene, gesture_);
  if (!ui_.problem.empty()) session_.say(ui_.problem, true);
  if (panels_.wishes.open) session_.open(*panels_.wishes.open);
  if (panels_.wishes.export_chart) session_.export_chart();
  if (panels_.wishes.split) {
    session_.set_split(*panels_.wishes.split);
    pacing_.on_new_start(now);
  }
  if (panels_.wishes.reference) ask_reference(dialog_);
  if (panels_.wishes.threads) session_.set_threads(*panels_.wishes.threads);
  select_view(panels_.view < error_view || session_.can_show_errors() ? panels_.view : 0);
  session_.send(now);
  if (session_.edit_number() != paced_edit_) pacing_.on_edit(paced_edit_ = session_.edit_number(), now);
  const Message& message = session_.message();
  if (!message.text.empty() && !message.error) {
    if (now >= message.until) {
      session_.dismiss();
      pacing_.on_event();  // this drawing still has it
    } else {
      pacing_.wake_at(message.until);
    }
  }
  if (ui_.wake_in < 1e299) pacing_.wake_at(now + ui_.wake_in);
  const Document& document = session_.document();
  const std::string title = document.origin->title + (edited(document) ? " (edited)" : "") + " – Tyndall";
  if (title != window_title_) platform_.set_title(window_title_ = title);
}

void MainWindow::finish_drawing(double now, double cpu_before, bool fresh) {
  pacing_.on_drawn(now);
  const double after = clock_seconds();
  const bool shown = fresh && shown_;
  if (shown) pacing_.on_picture(shown_->edit, after);
  if (!log_) return;
  if (shown) log_->shown(*shown_, after);
  log_->drawn(thread_cpu_seconds() - cpu_before, fresh);
}

int run_window(const WindowOptions& options) {
  // GLFW is not touched without a display: its error would say less.
  if (!is_set("DISPLAY") && !is_set("WAYLAND_DISPLAY"))
    throw IoError("no display: neither DISPLAY nor WAYLAND_DISPLAY is set");
  std::shared_ptr<const Reference> reference;
  if (!options.reference.empty())
    reference = std::make_shared<const Reference>(read_reference(options.reference, document_of(options.scene)));
  MainWindow window(options, std::move(reference));
  end_when_display_is_lost();
  window.run();
  return 0;
}

}  // namespace tyndall
