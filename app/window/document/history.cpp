#include "app/window/document/editor.h"

#include "core/scene/slots.h"

#include <map>

namespace tyndall {

namespace {

/// Whether both are the same, known to differ in the value at the pointer at most; "": in anything.
bool is_same(const Document& a, const Document& b, const std::string& pointer) {
  const auto now = pointer.empty() ? std::nullopt : find_slot(a.scene, pointer);
  const auto before = pointer.empty() ? std::nullopt : find_slot(b.scene, pointer);
  return now && before && now->value != before->value ? false : a == b;
}

}  // namespace

History::History(Document start) { steps_.push_back({std::make_shared<const Document>(std::move(start)), {}}); }

bool History::record(Document next, std::uint64_t gesture, const std::string& pointer) {
  if (is_same(next, current(), pointer)) return false;
  ObjectPaths selected = selection();
  steps_.resize(at_ + 1);
  if (open_ && gesture != 0 && gesture == gesture_) {
    if (at_ > 0 && is_same(next, *steps_[at_ - 1].document, pointer)) {
      steps_.pop_back();
      --at_;
      open_ = false;
    } else {
      steps_[at_].document = std::make_shared<const Document>(std::move(next));
      select(std::move(selected));
    }
    return true;
  }
  steps_.push_back({std::make_shared<const Document>(std::move(next)), {}});
  if (steps_.size() > max_steps) steps_.erase(steps_.begin());
  at_ = steps_.size() - 1;
  select(std::move(selected));
  gesture_ = gesture;
  open_ = true;
  return true;
}

void History::select(ObjectPaths selection) {
  std::erase_if(selection, [&](const ObjectPath& path) { return !find_object(current().scene, path); });
  steps_[at_].selection = std::move(selection);
}

void History::set_origin(const std::shared_ptr<const Origin>& origin) {
  // Every step of the same file is now compared with what was saved.
  const auto before = current().origin;
  for (auto& [document, selection] : steps_) {
    if (document->origin != before) continue;
    document = std::make_shared<const Document>(
        Document{move_textures(document->scene, before->folder, origin->folder), origin});
  }
}

bool History::take_pictures(const Scene& read) {
  const std::shared_ptr<const Origin> before = current().origin;
  std::map<std::string, std::shared_ptr<const Image::Pixels>> changed, now;  // by the name of a texture's or sky's file
  each_picture(read, [&](const auto& image) { now[image.file] = image.pixels; });
  each_picture(before->saved, [&](const auto& image) {
    const auto found = now.find(image.file);
    if (found != now.end() && !(*found->second == *image.pixels)) changed.insert(*found);
  });
  if (changed.empty()) return false;
  const auto take = [&](Scene& scene) {
    each_picture(scene, [&](auto& image) {
      if (const auto found = changed.find(image.file); found != changed.end()) image.pixels = found->second;
    });
  };
  auto origin = std::make_shared<Origin>(*before);
  take(origin->saved);
  for (Step& step : steps_) {
    if (step.document->origin != before) continue;
    Scene scene = step.document->scene;
    take(scene);
    step.document = std::make_shared<const Document>(Document{std::move(scene), origin});
  }
  return true;
}

/// The number of the step that unsaved() returns; steps_.size(): none.
std::size_t History::unsaved_step() const {
  for (std::size_t step = at_ + 1; step-- > 0;) {
    const Document& document = *steps_[step].document;
    const bool last_of_its_scene = step == at_ || document.origin->what != steps_[step + 1].document->origin->what;
    if (last_of_its_scene && edited(document)) return step;
  }
  return steps_.size();
}

const Document* History::unsaved() const {
  const std::size_t step = unsaved_step();
  return step < steps_.size() ? steps_[step].document.get() : nullptr;
}

/// Goes to a step, where there is one.
bool History::go_to(bool there_is, std::size_t step) {
  open_ = false;
  if (there_is) at_ = step;
  return there_is;
}

bool History::go_to_unsaved() { return unsaved() && go_to(true, unsaved_step()); }
bool History::undo() { return go_to(can_undo(), at_ - 1); }
bool History::redo() { return go_to(can_redo(), at_ + 1); }

}  // namespace tyndall
