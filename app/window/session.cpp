#include "app/window/session.h"

#include "app/window/document/open_document.h"
#include "app/window/document/snapshot.h"
#include "app/window/system/clock.h"
#include "core/base/error.h"
#include "core/scene/check.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <thread>
#include <utility>

namespace tyndall {

namespace fs = std::filesystem;

bool same_picture(const Scene& a, const Scene& b) {
  Scene shown = a;
  shown.display = b.display;
  shown.name = b.name;
  return shown == b;
}

Session::Session(const WindowOptions& options, std::function<void()> wake, std::function<void()> on_frame, UiLog* log)
    : reload_(options.reload),
      isa_(options.isa),
      reloads_(options.scene.source),
      log_(log),
      wake_(std::move(wake)),
      on_frame_([this, on_frame = std::move(on_frame)] {
        share_.on_frame();
        on_frame();
      }),
      history_(document_of(options.scene)),
      accuracy_(wake_),
      threads_(options.threads > 0 ? options.threads
                                   : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))),
      renderer_({options.threads, options.isa}, on_frame_),
      loading_([this] { came_ = true, wake_(); }),
      saving_([this] { came_ = true, wake_(); }) {
  share_.set_threads(threads_);
  accuracy_.set_threads(threads_);
  picture_changed();
  submit(clock_seconds());
  watch();
}

Session::~Session() {
  closing_ = true;
  share_.share_with(nullptr);  // the second renderer goes first
}

void Session::picture_changed() {
  if (changed_at_ < 0) changed_at_ = clock_seconds();
}

double Session::send_time() const {
  constexpr double patience = 0.4;  // seconds; longer, and what is shown is too far behind
  return changed_at_ < 0 ? std::numeric_limits<double>::infinity() : sent_at_ + patience;
}

bool Session::send(double now) {
  if (changed_at_ < 0) return false;
  const auto frame = latest();
  const bool seen = edit_ == 0 || (frame && frame->edit >= edit_);
  if (!seen && now < send_time()) return false;
  submit(now);
  return true;
}

void Session::submit(double now) {
  const std::uint64_t before = edit_;
  edit_ = renderer_.submit(scene());
  if (edit_ != before) accuracy_.set_scene(Half::current, scene());
  if (second_) submit_kept();
  if (log_ && edit_ != before) log_->submitted(edit_, changed_at_);
  changed_at_ = -1;
  sent_at_ = now;
}

void Session::edit(Scene next, std::uint64_t gesture) {
  if (next == scene()) return;
  if (const auto broken = check(next)) {
    say(broken->where + ": found " + broken->found + ", expected " + broken->expected, true);
    return;
  }
  const bool same = same_picture(next, scene());
  history_.record({std::move(next), document().origin}, gesture);
  if (message_.error) dismiss();
  if (!same) picture_changed();
}

void Session::undo() {
  const Scene before = scene();
  if (!history_.undo()) return say("nothing to undo");
  if (!same_picture(before, scene())) picture_changed();
  watch();
}

void Session::redo() {
  const Scene before = scene();
  if (!history_.redo()) return say("nothing to redo");
  if (!same_picture(before, scene())) picture_changed();
  watch();
}

void Session::show(Document next, bool own_file) {
  const bool same = same_picture(next.scene, scene());
  if (own_file && next.scene == scene()) {
    history_.set_origin(next.origin);  // the file now holds what is shown
    return;
  }
  history_.record(std::move(next), 0);
  if (!same) {
    if (!own_file) accuracy_.clear(), set_split(false);
    picture_changed();
  }
  watch();
  say((own_file ? "read again: " : "opened ") + document().origin->title);
}

void Session::read_in_background(const std::function<JobQueue::Result()>& read) {
  loading_.run([this, read]() -> JobQueue::Result {
    try {
      return read();
    } catch (const std::exception& error) {
      return [this, text = std::string(error.what())] { say(text, true); };
    }
  });
}

void Session::open(const std::string& what) {
  read_in_background([this, what]() -> JobQueue::Result {
    return [this, next = document_of(load_scene(what))] { show(next, false); };
  });
}

void Session::open_dropped(const fs::path& file) {
  read_in_background([this, file, document = document()]() -> JobQueue::Result {
    if (!shows_no_scene(file)) return [this, file] { open(file.string()); };
    return [this, reference = std::make_shared<const Reference>(read_reference(file, document))] {
      set_reference(reference);
    };
  });
}

void Session::reload() {
  const fs::path file = document().origin->file;
  const bool first = reload_ && file == reloads_;
  read_in_background([this, file, first]() -> JobQueue::Result {
    Document next = document_of(first ? reload_() : load_scene(fs::absolute(file).string()));
    return [this, file, next = std::move(next)] {
      if (document().origin->file == file) show(next, true);
    };
  });
}

void Session::watch() {
  const fs::path& file = document().origin->file;
  if (file == watched_) return;
  watch_.reset();
  watched_ = file;
  if (file.empty()) return;
  watch_ = std::make_unique<FileWatch>(file, [this] { file_changed_ = true, came_ = true, wake_(); });
}

void Session::save(fs::path file) {  // a copy: it may be that of the origin which is replaced here
  try {
    history_.set_origin(save_document(document(), file));
    watch();
    say("saved " + file.string());
    if (log_) log_->line("saved " + file.string());
  } catch (const std::exception& error) {
    say(error.what(), true);
  }
}

void Session::snapshot() {
  const auto frame = latest();
  if (!frame) return say("there is no picture yet");
  if (changed_at_ >= 0) submit(clock_seconds());  // what is saved is what is edited
  std::error_code gone;                           // the current folder may be; writing then says so
  const fs::path folder = fs::current_path(gone);
  const std::string stem = stem_of(document().origin->title);
  Snapshot snapshot{document(), numbered_base(folder, stem, snapshots_ + 1, {".png", ".exr"}), frame->isa,
                    frame->threads};
  snapshots_ = number_of(snapshot.base);
  say("saving " + snapshot.base.filename().string() + " …");
  saving_.run([this, snapshot = std::move(snapshot), edit = edit_number()]() -> JobQueue::Result {
    std::string text;
    bool failed = false;
    try {
      Film film = wait_for_film([this] { return renderer_.film(); }, [this, edit] { return edit_ == edit; },
                                [this] { return !closing_; });
      failed = film.pixels.empty();
      text = failed ? "no snapshot: the picture was edited before it had a sample everywhere"
                    : write_snapshot(snapshot, std::move(film));
    } catch (const std::exception& error) {
      text = error.what();
      failed = true;
    }
    return [this, text, failed, base = snapshot.base] {
      say(text, failed);
      if (log_ && !failed) log_->line("saved " + base.string());
    };
  });
}

void Session::pause(bool paused) {
  paused_ = paused;
  share_.pause(paused);
  accuracy_.set_resting(resting());
}

void Session::restart() {
  renderer_.restart();
  if (second_) second_->restart();
}

void Session::set_threads(int threads) {
  if (threads == threads_) return;
  threads_ = threads;
  share_.set_threads(threads);
  accuracy_.set_threads(threads);
}

bool Session::collect() {
  const bool came = came_.exchange(false);
  loading_.collect();
  saving_.collect();
  if (file_changed_.exchange(false)) reload();
  const auto problem = renderer_.problem();
  if (!problem || problem->edit <= problem_edit_) return came;
  problem_edit_ = problem->edit;
  say(problem->what, true);
  return true;
}

void Session::say(const std::string& text, bool error) {
  constexpr double seconds = 6;
  message_ = {text, error, clock_seconds() + seconds};
  if (log_) log_->line("message " + text);
}

}  // namespace tyndall
