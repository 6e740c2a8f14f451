#include "app/window/accuracy/references.h"

#include "app/text/numbers.h"

#include <exception>

namespace tyndall {

JobQueue::Result References::read(const std::filesystem::path& file, const Document& document) {
  return [this, reference = std::make_shared<const Reference>(read_reference(file, document))] { set(reference); };
}

void References::open(const std::filesystem::path& file) {
  editor_.read_in_background([this, file, document = shown_()] { return read(file, document); });
}

void References::open_dropped(const std::filesystem::path& file) {
  editor_.read_in_background([this, file, document = shown_()]() -> JobQueue::Result {
    if (shows_no_scene(file)) {
      if (document.origin->is_picture || !may_be_sky(file)) return read(file, document);
      return [this, file] { doubtful_ = file; };
    }
    return [this, file] { editor_.open(file.string()); };
  });
}

void References::drop() {
  stop();
  accuracy_.set_reference(nullptr);
}

void References::render(const ReferenceOrder& order) {
  const std::uint64_t number = ++order_;
  newest_ = order;
  doing_ = order.name.empty() ? "rendering a reference with another seed" : "rendering the reference " + order.name;
  rendered_ = std::make_shared<std::atomic<std::uint32_t>>(0);
  told_ = 0;
  messages_.say_until_done(doing_ + " …");
  rendering_.run([this, order, number, rendered = rendered_]() -> JobQueue::Result {
    double next = 0;
    const auto progress = [&](std::uint32_t spp) {
      *rendered = spp;
      if (clock_seconds() >= next) next = clock_seconds() + 0.5, wake_();
      return order_ == number;
    };
    std::shared_ptr<const Reference> made;
    try {
      if (auto reference = rendered_reference(order, progress))
        made = std::make_shared<const Reference>(std::move(*reference));
    } catch (const std::exception& error) {
      return [this, text = std::string(error.what())] { messages_.say("no reference: " + text, true); };
    }
    return [this, made, number] {
      if (made && order_ == number) set(made);
    };
  });
}

bool References::collect() {
  if (!busy()) return false;
  const Scene& began = newest_.shown;
  const ReferenceFit fit = fit_of({{began.width, began.height, {}}, 0, "", began, true}, shown_().scene);
  const bool other = fit == ReferenceFit::other_scene || fit == ReferenceFit::other_size;
  if (other && told_ < newest_.spp) {
    stop();
    messages_.say("no reference: the scene was changed");
    told_ = newest_.spp;  // it is told once
  }
  const std::uint32_t now = *rendered_;
  if (now > told_) {
    told_ = now;
    messages_.say_until_done(doing_ + ": " + format_count(now) + " of " + format_count(newest_.spp) + " spp");
  }
  return rendering_.collect();
}

void References::set(std::shared_ptr<const Reference> reference) {
  stop();
  std::string text = "reference: " + reference->about;
  for (const std::string& remark : reference->remarks) text += "; " + remark;
  messages_.say(text);
  accuracy_.set_reference(std::move(reference));
}

}  // namespace tyndall
