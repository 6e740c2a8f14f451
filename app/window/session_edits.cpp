#include "app/window/session.h"

#include "app/window/document/document.h"
#include "core/system/processors.h"

#include <fmt/core.h>

#include <utility>

/// What a session does so that edits that are in no file yet are not lost, and what it says of them; and what it does
/// as the rows of a picture come that another program writes, in place of a scene.
namespace tyndall {

/// Goes on with edits that a window before this one did not save: with those of the scene that is opened, or of any.
/// Settings of the command line apply to them, too.
void Session::restore_edits(const WindowOptions& options) {
  const std::filesystem::path file = kept_.take_over(options.scene_named ? editor.document().origin->what : "");
  kept_changes_ = editor.changes();
  try {
    if (!file.empty()) {
      Kept kept = read_kept(file, options.read_edits);
      editor.restore(std::move(kept.document), kept.file_changed);
    }
  } catch (const std::exception& error) {
    kept_.leave();
    messages.say("cannot restore edits: " + std::string(error.what()), true);
  }
  const std::vector<std::string> others = kept_.others();
  if (file.empty() && !others.empty())
    messages.say("there are edits of " + others.front() +
                 " that were not saved; starting with it, or where it is gone " + "without a scene, goes on with them");
}

/// Says once where edits are kept if that is not where they should be, and once that they cannot be kept: from the
/// first edit on that is so. Returns whether it said something.
bool Session::tell_of_keeping() {
  const Keeping now = kept_.keeping();
  if (now.kind == Keeping::Kind::nothing || now.kind == told_keeping_) return false;
  const Keeping::Kind before = std::exchange(told_keeping_, now.kind);
  if (now.kind == Keeping::Kind::lost)
    messages.say_until_done("edits cannot be kept: " + now.why +
                            "; until they are saved, they are lost when the window ends");
  else if (now.kind == Keeping::Kind::beside)
    messages.say_until_done("edits are kept in " + now.file.string() +
                            (now.why.empty() ? "" : ", because of: " + now.why));
  else if (before == Keeping::Kind::lost)
    messages.say("edits can be kept again, and are");
  else
    return false;
  return true;
}

void Session::keep_edits() {
  if (editor.changes() == kept_changes_ || discarded_) return;
  kept_changes_ = editor.changes();
  const Document* unsaved = this->unsaved();
  if (unsaved == &editor.document())
    kept_.keep(editor.shared(), unsaved->origin);
  else if (unsaved)
    kept_.keep(std::make_shared<const Scene>(unsaved->scene), unsaved->origin);
  else
    kept_.keep(nullptr, nullptr);
}

const Document* Session::unsaved() const {
  const Document* edits = editor.unsaved();
  return edits && edits->origin->is_picture ? nullptr : edits;
}

void Session::discard_edits() {
  discarded_ = true;
  kept_.keep(nullptr, nullptr);
}

/// Takes what has come since the last time. Whether anything has.
bool Session::collect_rows() {
  if (!picture_) return false;
  const Arrival before = std::exchange(arrival_, picture_->arrival());
  if (arrival_ == before) return false;
  if (shows_picture()) ++wanted.restarts;
  if (arrival_.said != before.said) messages.say(arrival_.said, true);
  return true;
}

/// Tells of the first sample that the function could not compute. Whether that is news.
bool Session::collect_problem() {
  if (!function_) return false;
  const std::string problem = function_->first_problem();
  if (problem == told_function_problem_) return false;
  messages.say(told_function_problem_ = problem, true);
  return true;
}

/// Where samples come from; null: from the scene.
std::shared_ptr<const SampleSource> Session::source() const {
  if (!shows_picture()) return nullptr;
  return picture_ ? picture_->source() : function_->source();
}

void Session::render_reference(const LoadedScene& loaded) {
  constexpr int usual = 256;
  const auto spp = static_cast<std::uint32_t>(loaded.scene.render.spp.value_or(usual));
  references.render({loaded.scene, spp, thread_count(0).count, isa_, title_of(loaded.name), *rendered_scene()});
}

std::string Session::arrived() const {
  if (!shows_picture() || !picture_) return "";
  if (arrival_.rows == picture_->height()) return fmt::format("all {} rows", arrival_.rows);
  return fmt::format("{} {} of {}", arrival_.ended ? "ended at row" : "row", arrival_.rows, picture_->height());
}

}  // namespace tyndall
