#include "app/curves/chart_export.h"
#include "app/window/document/open_document.h"
#include "app/window/document/snapshot.h"
#include "app/window/session.h"

#include <exception>
#include <utility>

/// The part of Session that is about errors.
namespace tyndall {

namespace fs = std::filesystem;

void Session::shown(Half half, const std::shared_ptr<const Frame>& frame) {
  const bool newest = frame->edit == (half == Half::kept ? kept_edit_ : edit_number());
  accuracy_.shown(half, frame, method(half), newest);
  accuracy_.set_resting(resting());
}

bool Session::resting() const {
  const auto finished = [](const std::shared_ptr<const Frame>& one) { return !one || one->finished; };
  return paused_ || (finished(latest()) && finished(latest_kept()));
}

std::string Session::method(Half half) const {
  return method_of(half == Half::kept ? kept_ : scene().render, document().origin->saved.render);
}

void Session::set_view(View view, ErrorView error) {
  view_ = view;
  renderer_.set_view(view);
  if (second_) second_->set_view(view);
  accuracy_.set_view(error);
}

void Session::open_reference(const fs::path& file) {
  read_in_background([this, file, document = document()]() -> JobQueue::Result {
    return [this, reference = std::make_shared<const Reference>(read_reference(file, document))] {
      set_reference(reference);
    };
  });
}

void Session::set_reference(std::shared_ptr<const Reference> reference) {
  say("reference: " + reference->about);
  accuracy_.set_reference(std::move(reference));
}

void Session::keep_as_reference() {
  const auto frame = latest();
  if (!frame || frame->spp == 0 || frame->edit != edit_ || changed_at_ >= 0) return say("there is no picture yet");
  set_reference(std::make_shared<const Reference>(reference_of(*frame, scene())));
}

void Session::drop_reference() { accuracy_.set_reference(nullptr); }

void Session::set_split(bool split) {
  if (split == this->split()) return;
  accuracy_.set_split(split);
  if (!split) {
    share_.share_with(nullptr);
    saving_.run([second = std::move(second_)]() mutable -> JobQueue::Result {  // it may be within a pass
      second.reset();
      return {};
    });
    return;
  }
  kept_ = scene().render;
  second_ = std::make_shared<Renderer>(Renderer::Options{threads_, isa_}, on_frame_);
  second_->set_view(view_);
  kept_edit_ = 0;
  submit_kept();
  renderer_.restart();
  share_.share_with(second_.get());
}

void Session::submit_kept() {
  Scene left = scene();
  const auto limit = left.render.spp;
  left.render = kept_;
  left.render.spp = limit;
  const std::uint64_t before = kept_edit_;
  kept_edit_ = second_->submit(left);
  if (kept_edit_ != before) accuracy_.set_scene(Half::kept, left);
}

bool Session::can_show_errors() const {
  return accuracy_.split() || (accuracy_.reference() && accuracy_.fit(Half::current) != ReferenceFit::other_size);
}

void Session::export_chart() {
  const bool against = accuracy_.is_true();
  const std::vector<NamedRun> runs =
      named_runs(accuracy_.curves(Half::current), accuracy_.split() ? &accuracy_.curves(Half::kept) : nullptr);
  const std::string stem = stem_of(document().origin->title);
  const std::string of = against ? ": true error against " + accuracy_.reference()->about : ": estimated error";
  Chart chart = live_chart(runs, stem + of,
                           std::to_string(scene().width) + "x" + std::to_string(scene().height) + ", " +
                               std::to_string(threads_) + (threads_ == 1 ? " thread" : " threads") +
                               (against ? "" : "; estimated from two halves of each pixel"));
  if (chart.curves.empty()) return say("there is no curve yet");
  std::error_code gone;  // the current folder may be; writing then says so
  const fs::path base = numbered_base(fs::current_path(gone), stem + "-chart", charts_ + 1, {".csv", ".svg"});
  charts_ = number_of(base);
  saving_.run([this, chart = std::move(chart), base]() -> JobQueue::Result {
    try {
      const std::string text = write_chart(chart, base);
      return [this, text, base] {
        say(text);
        if (log_) log_->line("saved " + base.string());
      };
    } catch (const std::exception& error) {
      return [this, text = std::string(error.what())] { say(text, true); };
    }
  });
}

}  // namespace tyndall
