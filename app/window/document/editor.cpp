#include "app/window/document/editor.h"

#include "app/window/document/open_document.h"
#include "core/render/mailbox.h"
#include "core/scene/check.h"

#include <cmath>
#include <exception>
#include <optional>
#include <utility>

namespace tyndall {

namespace fs = std::filesystem;

bool same_picture(const Scene& a, const Scene& b) {
  return change_between(a, b).none() && a.render.spp == b.render.spp;
}

Editor::Editor(const LoadedScene& scene, std::function<LoadedScene()> reload, EditorEvents events, JobQueue& jobs,
               MessageLine& messages, UiLog* log)
    : reload_(std::move(reload)),
      reloads_(scene.source),
      events_(std::move(events)),
      jobs_(jobs),
      messages_(messages),
      log_(log),
      history_(document_of(scene)) {
  watch();
}

void Editor::edit(Scene next, std::uint64_t gesture) {
  if (next == scene()) return;
  if (const auto broken = check(next)) {
    messages_.say(broken->where + ": found " + broken->found + ", expected " + broken->expected, true);
    return;
  }
  const bool same = same_picture(next, scene());
  history_.record({std::move(next), document().origin}, gesture);
  ++changes_;
  if (messages_.current().error) drop_message();
  if (!same) events_.picture_changed();
}

void Editor::undo() { step(&History::undo, "nothing to undo"); }
void Editor::redo() { step(&History::redo, "nothing to redo"); }

void Editor::step(bool (History::*move)(), const char* otherwise) {
  const Scene before = scene();
  const ObjectPaths selected = selection();
  if (!(history_.*move)()) return messages_.say(otherwise);
  ++changes_;
  ObjectPaths now = paths_after(before, scene(), selected);
  if (!now.empty() && now.size() == selected.size()) select(std::move(now));
  if (std::isfinite(messages_.current().until)) drop_message();  // it was about what is undone now
  if (!same_picture(before, scene())) events_.picture_changed();
  watch();
}

/// Takes the message away that an edit has answered. What is wrong with the file stays true.
void Editor::drop_message() { unreadable_.empty() ? messages_.dismiss() : messages_.say(unreadable_, true); }

void Editor::go_to_unsaved() { step(&History::go_to_unsaved, ""); }

void Editor::restore(Document restored, bool file_changed) {
  const std::string title = restored.origin->title;
  if (restored.origin->what == document().origin->what) restored.origin = document().origin;
  history_.record(std::move(restored), 0);
  ++changes_;
  events_.picture_changed();
  watch();
  if (file_changed && edited(document())) changed_file_ = Document{document().origin->saved, document().origin};
  messages_.say("restored the edits of " + title + " that were not saved; Ctrl + Z: without them");
}

void Editor::answer_about_file(bool take) {
  if (!changed_file_) return;
  Document file = *std::exchange(changed_file_, std::nullopt);
  if (file.origin->what != document().origin->what) return;  // another scene was opened meanwhile
  ++changes_;
  if (take) return show(std::move(file), true);
  history_.set_origin(file.origin);
  messages_.say("kept your edits; saving replaces what " + document().origin->title + " holds");
}

void Editor::show(Document next, bool own_file, const OpenedFilm& film) {
  ++changes_;
  const bool same = same_picture(next.scene, scene());
  if (own_file && next.scene == scene()) {
    history_.set_origin(next.origin);  // the file now holds what is shown
    return;
  }
  const ObjectPaths selected = own_file ? paths_after(scene(), next.scene, selection()) : ObjectPaths{};
  const std::string left = !own_file && edited(document()) ? document().origin->title : "";
  history_.record(std::move(next), 0);
  select(selected);
  if (!same) {
    if (!own_file) events_.other_scene();
    events_.picture_changed();
  }
  watch();
  std::string remarks;
  for (const std::string& remark : texture_remarks(scene())) remarks += "; " + remark;
  messages_.say((own_file ? "read again: " : "opened ") + document().origin->title +
                (film.word.empty() ? "" : "; " + film.word) +
                (left.empty() ? "" : "; Ctrl + Z goes back to the edits of " + left) + remarks);
  if (film.film) events_.film_opened(film.film);
}

void Editor::read_in_background(const std::function<JobQueue::Result()>& read) {
  jobs_.run([this, read]() -> JobQueue::Result {
    try {
      return read();
    } catch (const std::exception& error) {
      return [this, text = std::string(error.what())] { messages_.say(text, true); };
    }
  });
}

void Editor::open(const std::string& what) {
  read_in_background([this, what]() -> JobQueue::Result {
    const LoadedScene loaded = load_scene(what);
    return [this, next = document_of(loaded), film = events_.film_of(loaded)] { show(next, false, film); };
  });
}

void Editor::open_film(const LoadedScene& scene) {
  read_in_background([this, scene, before = changes_]() -> JobQueue::Result {
    return [this, before, film = events_.film_of(scene)] {
      if (changes_ != before || film.word.empty()) return;
      messages_.say("opened " + document().origin->title + "; " + film.word);
      if (film.film) events_.film_opened(film.film);
    };
  });
}

void Editor::reload() {
  const fs::path file = document().origin->file;
  const bool first = reload_ && file == reloads_;
  read_in_background([this, file, first]() -> JobQueue::Result {
    std::optional<Document> next;
    std::string wrong;
    try {
      next = document_of(first ? reload_() : load_scene(fs::absolute(file).string()));
    } catch (const std::exception& error) {
      wrong = error.what();
    }
    return [this, file, next = std::move(next), wrong] {
      if (document().origin->file != file) return;
      unreadable_ = wrong;
      if (!next) return messages_.say(wrong, true);
      if (log_) log_->line("read " + file.string());
      take_file(*next);
    };
  });
}

/// Takes what the open file holds now. Asks first if that would replace edits.
void Editor::take_file(const Document& file) {
  if (file.scene == document().origin->saved)
    history_.set_origin(file.origin);  // it was only written again
  else if (edited(document()) && !(file.scene == scene()))
    changed_file_ = file;
  else
    show(file, true);
}

void Editor::watch() {
  const fs::path& file = document().origin->file;
  if (file == watched_) return;
  watch_.reset();
  unreadable_.clear();
  watched_ = file;
  if (file.empty()) return;
  watch_ = std::make_unique<FileWatch>(file, [this] { file_changed_ = true, events_.wake(); });
}

bool Editor::save(const fs::path& file) {
  try {
    const std::string saved = "saved " + file.string();  // first: the file may be that of the origin which is replaced
    history_.set_origin(save_document(document(), file));
    ++changes_;
    watch();
    unreadable_.clear();
    changed_file_.reset();
    messages_.say(saved);
    if (log_) log_->line(saved);
    return true;
  } catch (const std::exception& error) {
    messages_.say(error.what(), true);
    return false;
  }
}

bool Editor::collect() {
  if (!file_changed_.exchange(false)) return false;
  reload();
  return true;
}

}  // namespace tyndall
