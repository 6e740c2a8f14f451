#include "app/window/accuracy/references.h"

#include <utility>

namespace tyndall {

JobQueue::Result References::read(const std::filesystem::path& file, const Document& document) {
  return [this, reference = std::make_shared<const Reference>(read_reference(file, document))] { set(reference); };
}

void References::open(const std::filesystem::path& file) {
  editor_.read_in_background([this, file, document = editor_.document()] { return read(file, document); });
}

void References::open_dropped(const std::filesystem::path& file) {
  editor_.read_in_background([this, file, document = editor_.document()]() -> JobQueue::Result {
    if (shows_no_scene(file)) return read(file, document);
    return [this, file] { editor_.open(file.string()); };
  });
}

void References::set(std::shared_ptr<const Reference> reference) {
  messages_.say("reference: " + reference->about);
  accuracy_.set_reference(std::move(reference));
}

}  // namespace tyndall
