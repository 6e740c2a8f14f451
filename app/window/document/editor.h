#pragma once
#include "app/window/document/document.h"
#include "app/window/document/job_queue.h"
#include "app/window/document/message.h"
#include "core/scene/load.h"
#include "core/system/file_watch.h"

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// This room holds the document, that is the scene that is edited with its history and its file, and the work that is
/// done for it in the background. It knows nothing of rendering.
namespace tyndall {

/// What edits for as long as it lasts: a button or key that is down, or the turning wheel.
enum class Gesture { none, held, wheel };

/// Gives every gesture a number. All edits between the press of a button or key and its release have the same number,
/// and so have those of a wheel that turns on: they are one step to undo.
class Gestures {
 public:
  /// To be called in each drawing, before its edits are kept.
  void update(Gesture now) {
    if (now == Gesture::none || now != last_) ++number_;
    last_ = now;
  }
  /// The number of edits that are made now.
  std::uint64_t current() const { return number_; }
  /// A number for one edit that is a step of its own.
  std::uint64_t begin() {
    last_ = Gesture::none;
    return ++number_;
  }

 private:
  std::uint64_t number_ = 1;
  Gesture last_ = Gesture::none;
};

/// Undo and redo: a list of copies. Never empty.
class History {
 public:
  explicit History(Document start);

  const Document& current() const { return *steps_[at_].document; }
  /// Its scene, which never changes: the next edit makes another one.
  std::shared_ptr<const Scene> shared() const { return {steps_[at_].document, &current().scene}; }
  /// What is selected; each step has its own, so that undo and redo select what was selected there.
  const ObjectPaths& selection() const { return steps_[at_].selection; }
  /// Paths that lead nowhere are left out.
  void select(ObjectPaths selection);
  /// The newest step up to the current one that holds edits which no file has: the current one, or the last one before
  /// another scene was opened. Null: there is none.
  const Document* unsaved() const;
  /// Goes back to the step that unsaved() returns; false: there is none.
  bool go_to_unsaved();
  /// Makes `next` the current document and forgets what was undone; nothing happens if it equals the current one.
  /// Edits of the same gesture (a drag, a turn of the wheel; 0: none) that follow each other are one step; no step is
  /// left of a gesture that ends as it began. The selection stays. pointer: of the value in which it is known to
  /// differ;
  /// "": it may equal the current one. Returns whether it differs.
  bool record(Document next, std::uint64_t gesture, const std::string& pointer = "");
  /// The file was written, maybe to another folder: all steps that came from it are from now on compared with what it
  /// holds, and their textures are respelt for its folder. No step.
  void set_origin(const std::shared_ptr<const Origin>& origin);
  /// The scene's file was read again: where the files of its textures hold other pictures now, all steps that came from
  /// it, and what they are compared with, show these from now on. No step. Returns whether there was such a picture.
  bool take_pictures(const Scene& read);
  /// False at the end of the list.
  bool undo();
  bool redo();
  bool can_undo() const { return at_ > 0; }
  bool can_redo() const { return at_ + 1 < steps_.size(); }

  /// Older steps are forgotten.
  static constexpr std::size_t max_steps = 200;

 private:
  std::size_t unsaved_step() const;
  bool go_to(bool there_is, std::size_t step);

  struct Step {
    std::shared_ptr<const Document> document;
    ObjectPaths selection;
  };
  std::vector<Step> steps_;
  std::size_t at_ = 0;
  std::uint64_t gesture_ = 0;
  bool open_ = false;  ///< the newest step may still take edits of gesture_
};

/// Whether both scenes render to the same picture: equal but for what is applied when it is shown.
bool same_picture(const Scene& a, const Scene& b);

/// What an editor calls when something has happened.
struct EditorEvents {
  std::function<void()> picture_changed;                   ///< the scene renders to another picture now
  std::function<void()> other_scene;                       ///< another scene was opened; told before picture_changed
  std::function<OpenedFilm(const LoadedScene&)> film_of;   ///< reads the film of an opened image; in the background
  std::function<void(std::shared_ptr<Film>)> film_opened;  ///< of the scene that is shown now; told after the others
  std::function<void()> wake;                              ///< collect() has something to do; called from any thread
};

/// The open document: takes edits, undoes, opens, saves, and reads the file again when another program has written it.
/// For the main thread; it waits for files only while it saves.
class Editor {
 public:
  /// reload: reads the first scene again, as the command line asked for it; may be empty. jobs: for reading; it may be
  /// constructed later than the editor, and ends before it. log: may be null.
  Editor(const LoadedScene& scene, std::function<LoadedScene()> reload, EditorEvents events, JobQueue& jobs,
         MessageLine& messages, UiLog* log);

  const Document& document() const { return history_.current(); }
  const Scene& scene() const { return history_.current().scene; }
  /// The scene for all who go on using it; never changes.
  std::shared_ptr<const Scene> shared() const { return history_.shared(); }

  /// Whether the scene differs from what its file holds; found out once after each change.
  bool edited() const;

  /// Takes an edited scene: checks and remembers it. What is broken is refused with a message. gesture: edits of the
  /// same number that follow each other are one step to undo; 0: none. pointer: of the value in which it differs, by
  /// which no scenes need to be compared; "": it may differ in anything.
  void edit(Scene scene, std::uint64_t gesture, const std::string& pointer = "");
  /// The same of a change to a copy of the scene, as a step to undo of its own.
  template <class F>
  void change(const F& change_of) {
    Scene next = scene();
    change_of(next);
    edit(std::move(next), gestures.begin());
  }
  void undo();
  void redo();
  /// What is selected. Edits, undo and redo keep it, wherever it stands then; what undo or redo take away gives place
  /// to what was selected there.
  const ObjectPaths& selection() const { return history_.selection(); }
  void select(ObjectPaths selection) { history_.select(std::move(selection)); }
  /// Counts the edits, undone ones and saved ones too: the same number means the same document.
  std::uint64_t changes() const { return changes_; }

  /// Edits that no file has, see History::unsaved; null: there are none.
  const Document* unsaved() const { return edited() ? &document() : history_.unsaved(); }
  /// Shows these edits, if another scene was opened since.
  void go_to_unsaved();
  /// Goes on with edits of an earlier window; one undo goes back to the scene as it was opened. file_changed: another
  /// program has changed the file since, which the user is asked about.
  void restore(Document document, bool file_changed);

  /// Opens a file or a built-in scene, in the background. what: as the command line takes it. Of programs only the one
  /// that was named there is opened: anything else would compile and run what the user has only looked at.
  void open(const std::string& what);
  /// Reads the film of the first scene, if that was opened from an image, in the background.
  void open_film(const LoadedScene& scene);
  /// Makes a picture file the scene's sky, in the background; it can be undone.
  void set_sky(const std::filesystem::path& file);
  /// Writes the scene to its own file, or to another one, and says how it went. An existing file is replaced: see
  /// file_differs(). Returns whether it was written.
  bool save(const std::filesystem::path& file);

  /// Runs `read` in the background. Then collect() calls the function that it returned, or shows what it threw as a
  /// message.
  void read_in_background(const std::function<JobQueue::Result()>& read);
  /// Reads the scene again, in the background, if another program has changed its file or one of its textures. Returns
  /// whether one has.
  bool collect();
  /// Another program has changed the file while there are edits of it: what the file holds now waits for an answer.
  bool offers_reload() const { return changed_file_.has_value(); }
  /// The answer: takes what the file holds, which can be undone, or keeps the edits.
  void answer_about_file(bool take);
  /// Whether one of these files was changed and collect() has not been called since.
  bool file_changed() const { return file_changed_; }

  Gestures gestures;

 private:
  void show(Document document, bool own_file, const OpenedFilm& film = {});
  void step(bool (History::*move)(), const char* otherwise);
  void drop_message();
  void watch();
  void reload();
  void take_reading(const Document* read, const std::string& wrong, const std::vector<std::filesystem::path>& needed);
  void take_file(const Document& file);

  std::function<LoadedScene()> reload_;
  std::string reloads_;  ///< what reload_ reads: Origin::what
  EditorEvents events_;
  JobQueue& jobs_;
  MessageLine& messages_;
  UiLog* log_;
  History history_;
  std::uint64_t changes_ = 0;
  mutable std::optional<std::uint64_t> compared_changes_;  ///< when edited_ was found out
  mutable bool edited_ = false;
  std::string pointer_;                   ///< of the value that the last edit has set; "": it was another one
  std::string unreadable_;                ///< what is wrong with the files as they are now; empty: nothing
  std::optional<Document> changed_file_;  ///< what the file holds, while the user is asked about it
  std::atomic<bool> file_changed_ = false;
  bool reads_again_ = false;   ///< the next reading waits for the end of this one, which may take seconds for a program
  std::string watched_scene_;  ///< Origin::what
  std::vector<std::filesystem::path> watched_;
  std::vector<std::filesystem::path> unreadable_files_;  ///< what a reading depends on that has failed; watched, too
  std::unique_ptr<FileWatch> watch_;                     // declared last, because it uses the others
};

}  // namespace tyndall
