#include "app/window/document/editor.h"

#include "app/book/load_program.h"
#include "core/scene/check.h"
#include "core/scene/slots.h"

#include <cmath>
#include <exception>

namespace tyndall {

namespace fs = std::filesystem;

bool same_picture(const Scene& a, const Scene& b) {
  return change_between(a, b).none() && a.render.spp == b.render.spp;
}

Editor::Editor(const LoadedScene& scene, std::function<LoadedScene()> reload, EditorEvents events, JobQueue& jobs,
               MessageLine& messages, UiLog* log)
    : reload_(std::move(reload)),
      events_(std::move(events)),
      jobs_(jobs),
      messages_(messages),
      log_(log),
      history_(document_of(scene)) {
  reloads_ = document().origin->what;
  watch();
}

void Editor::edit(Scene next, std::uint64_t gesture, const std::string& pointer) {
  const bool of_value = !pointer.empty();
  if (!of_value && next == scene()) return;
  if (!of_value) move_keys(scene(), next);  // a value moves no object in its list
  if (const auto error = check(next)) {
    messages_.say(error->where + ": found " + error->found + ", expected " + error->expected, true);
    return;
  }
  const bool of_display = pointer.starts_with("/display/") || pointer.starts_with("/animation/");
  const bool same = of_value ? of_display : same_picture(next, scene());
  history_.record({std::move(next), document().origin}, gesture, pointer);
  ++changes_;
  pointer_ = pointer;
  if (messages_.current().error) drop_message();
  if (!same) events_.picture_changed();
}

bool Editor::edited() const {
  if (std::exchange(compared_changes_, changes_) == changes_) return edited_;
  const auto now = find_slot(scene(), pointer_), saved = find_slot(document().origin->saved, pointer_);
  return edited_ = (now && saved && now->value != saved->value) || tyndall::edited(document());
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
  if (file_changed && tyndall::edited(document()))
    changed_file_ = Document{document().origin->saved, document().origin};
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
  const std::string left = !own_file && tyndall::edited(document()) ? document().origin->title : "";
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
                (film.remark.empty() ? "" : "; " + film.remark) +
                (left.empty() ? "" : "; Ctrl + Z goes back to the edits of " + left) + remarks);
  if (film.film) events_.film_opened(film.film);
}

void Editor::set_sky(const std::filesystem::path& file) {
  read_in_background([this, file, folder = document().origin->folder]() -> JobQueue::Result {
    return [this, folder, sky = sky_of_file(file, folder)] {
      if (document().origin->folder != folder) return;  // another scene was opened in the meantime
      change([&](Scene& changed) { changed.background = sky; });
      watch();
      messages_.say("the sky is " + sky.file + "; Ctrl + Z takes it away");
    };
  });
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
  const bool first = reload_ && what == reloads_;
  if (is_program(what) && !first)
    return messages_.say(title_of(what) + " is a program, which is compiled and run only where it is named on the " +
                             "command line: tyndall " + title_of(what),
                         true);
  read_in_background([this, what, first]() -> JobQueue::Result {
    const LoadedScene loaded = first && is_program(what) ? reload_() : load_scene(what);
    return [this, next = document_of(loaded), film = events_.film_of(loaded)] { show(next, false, film); };
  });
}

void Editor::open_film(const LoadedScene& scene) {
  read_in_background([this, scene, before = changes_]() -> JobQueue::Result {
    return [this, before, film = events_.film_of(scene)] {
      if (changes_ != before || film.remark.empty()) return;
      messages_.say("opened " + document().origin->title + "; " + film.remark);
      if (film.film) events_.film_opened(film.film);
    };
  });
}

void Editor::reload() {
  reads_again_ = true;
  const std::string what = document().origin->what;
  const fs::path file = document().origin->file;
  const bool first = reload_ && what == reloads_;
  read_in_background([this, what, file, first]() -> JobQueue::Result {
    std::optional<Document> next;
    std::string wrong;
    std::vector<fs::path> needed;
    try {
      next = document_of(first ? reload_() : load_scene(file.empty() ? what : fs::absolute(file).string()));
    } catch (const std::exception& error) {
      wrong = error.what();
      if (!file.empty()) needed = files_of_scene(file);
    }
    return [this, what, next = std::move(next), wrong, needed = std::move(needed)] {
      reads_again_ = false;
      if (document().origin->what == what) take_reading(next ? &*next : nullptr, wrong, needed);
    };
  });
}

/// The files were read again. read: null: in vain; wrong: why; needed: the files that reading depends on then.
void Editor::take_reading(const Document* read, const std::string& wrong, const std::vector<fs::path>& needed) {
  const std::vector<fs::path> watched = watched_;
  const std::string before = std::exchange(unreadable_, wrong);
  unreadable_files_ = needed;
  if (read) {
    if (log_) log_->line("read " + (read->origin->file.empty() ? read->origin->what : read->origin->file.string()));
    take_file(*read);
    if (!before.empty() && messages_.current().text == before) messages_.say("read again: " + document().origin->title);
  } else {
    messages_.say(wrong, true);
  }
  watch();
  if (watched_ != watched) file_changed_ = true;  // what is watched only now may have changed since it was read
}

/// Takes what the open files hold now. Asks first if that would replace edits; textures, which nobody edits here, are
/// taken in any case.
void Editor::take_file(const Document& file) {
  const Scene before = scene();
  if (history_.take_pictures(file.scene)) {
    ++changes_;
    if (!same_picture(before, scene())) events_.picture_changed();
    messages_.say("read again: textures of " + document().origin->title);
  }
  if (file.scene == document().origin->saved)
    history_.set_origin(file.origin);  // it was only written again
  else if (tyndall::edited(document()) && !(file.scene == scene()))
    changed_file_ = file;
  else
    show(file, true);
}

void Editor::watch() {
  const std::string& what = document().origin->what;
  if (std::exchange(watched_scene_, what) != what) {
    unreadable_.clear();
    unreadable_files_.clear();
  }
  std::vector<fs::path> files = watched_files(document());
  files.insert(files.end(), unreadable_files_.begin(), unreadable_files_.end());
  if (files == watched_) return;
  watch_.reset();
  watched_ = files;
  if (files.empty()) return;
  watch_ = std::make_unique<FileWatch>(files, [this] { file_changed_ = true, events_.wake(); });
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
  if (reads_again_ || !file_changed_.exchange(false)) return false;
  reload();
  return true;
}

}  // namespace tyndall
