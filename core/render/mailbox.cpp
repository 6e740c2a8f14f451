#include "core/render/mailbox.h"

#include "core/base/seconds.h"
#include "core/scene/scene.h"

#include <algorithm>
#include <utility>

namespace tyndall {
namespace {

constexpr int default_spp = 4096;  // samples a pixel, where the scene names none

/// Whether the second request is for another picture than the first. Without a scene it is for none.
bool is_edit(const RenderRequest& before, const RenderRequest& after) {
  if (!after.scene) return false;
  if (!before.scene || after.samples != before.samples) return true;
  if (after.film && after.film != before.film) return true;
  return after.scene != before.scene && !change_between(*before.scene, *after.scene).none();
}

}  // namespace

std::uint32_t ReceivedRequest::full_spp() const {
  return wanted.scene ? static_cast<std::uint32_t>(wanted.scene->render.spp.value_or(default_spp)) : 0;
}

RequestChange change_between(const ReceivedRequest& before, const ReceivedRequest& after) {
  const RenderRequest &a = before.wanted, &b = after.wanted;
  return {.scene = before.edit != after.edit,
          .restart = a.restarts != b.restarts,
          .threads = a.threads != b.threads,
          .pixel = a.watched_pixel != b.watched_pixel,
          .drawing = a.view != b.view || a.clean != b.clean,
          .limit = before.full_spp() != after.full_spp()};
}

std::uint64_t Mailbox::request(RenderRequest request) {
  const std::lock_guard lock(mutex_);
  if (request == newest_.wanted) return newest_.edit;
  const bool edit = is_edit(newest_.wanted, request);
  if (edit) ++newest_.edit;
  if (edit || request.restarts != newest_.wanted.restarts) newest_.since = Clock::now();
  newest_.wanted = std::move(request);
  if (change_between(taken_, newest_).is_urgent()) give_up_ = true;
  news_.notify_one();
  return newest_.edit;
}

void Mailbox::note_shown(std::uint64_t pass) {
  const std::lock_guard lock(mutex_);
  if (pass <= shown_pass_) return;
  shown_pass_ = pass;
  shown_at_ = Clock::now();
  news_.notify_one();
}

std::optional<double> Mailbox::wait_until_shown(std::uint64_t pass) {
  constexpr auto patience = std::chrono::milliseconds(50);
  std::unique_lock lock(mutex_);
  if (shown_pass_ == 0) return {};
  news_.wait_for(lock, patience, [&] { return shown_pass_ >= pass || give_up_; });
  if (shown_pass_ < pass) return {};
  return seconds_between(posted_at_, shown_at_);
}

std::future<Film> Mailbox::ask_for_film() {
  const std::lock_guard lock(mutex_);
  auto answer = films_.emplace_back().get_future();
  news_.notify_one();
  return answer;
}

bool Mailbox::wait(const std::function<bool(std::uint32_t limit)>& unfinished) {
  std::unique_lock lock(mutex_);
  news_.wait(lock, [&] {
    return stops_ || change_between(taken_, newest_).any() || !films_.empty() || unfinished(newest_.limit());
  });
  return !stops_;
}

void Mailbox::post(std::shared_ptr<Frame> frame) {
  const std::lock_guard lock(mutex_);
  frame->finished = frame->spp >= newest_.full_spp() && !frame->awaits_clean;
  reply_.frame = std::move(frame);
  posted_at_ = Clock::now();
}

void Mailbox::post(std::shared_ptr<const PreparedScene> scene) {
  const std::lock_guard lock(mutex_);
  prepared_ = std::move(scene);
  reply_.problem = nullptr;
}

}  // namespace tyndall
