#pragma once
#include "app/window/document/document.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

/// Undo and redo.
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

}  // namespace tyndall
