#include "app/book/own_program.h"

#include "core/base/error.h"
#include "core/base/seconds.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace tyndall {

OwnProgram::OwnProgram(std::string name, ChildPlan plan, std::function<bool()> go_on)
    : name_(std::move(name)), go_on_(std::move(go_on)) {
  auto [mine, its] = connected_pair();
  if (!mine) throw IoError(name_ + ": cannot be run: too many files are open");
  channel_ = std::move(mine);
  plan.channel = its.descriptor();
  plan.environment.push_back("TYNDALL_BOOK_CHANNEL=" + std::to_string(plan.channel));
  plan.seconds = 1e9;
  plan.go_on = [this] {
    const std::lock_guard lock(wanted_mutex_);
    return !stops_ && (!go_on_ || go_on_());
  };
  end_ = std::async(std::launch::async, [plan = std::move(plan), its = std::move(its)]() mutable {
    ChildEnd end = run_child(plan);
    its.close();
    return end;
  });
}

OwnProgram::~OwnProgram() { end(); }

void OwnProgram::leave_alone() {
  const std::lock_guard lock(wanted_mutex_);
  go_on_ = nullptr;
}

std::optional<OwnProgram::Message> OwnProgram::next_message(double seconds) {
  const int milliseconds = static_cast<int>(1000 * seconds);
  tyndall_book::message_head head;
  constexpr double largest = 300.0 * (1 << 20);  // more than any scene's or picture's
  if (!receive(channel_, &head, sizeof head, milliseconds) || !(head.size >= 0 && head.size <= largest)) return {};
  Message message{static_cast<char>(head.letter), std::string(static_cast<std::size_t>(head.size), 0)};
  if (!receive(channel_, message.bytes.data(), message.bytes.size(), milliseconds)) return {};
  return message;
}

std::vector<Vec3d> OwnProgram::samples(const std::vector<tyndall_book::pixel_place>& places) {
  constexpr std::size_t largest = 1 << 16;
  const std::lock_guard lock(mutex_);
  std::vector<Vec3d> colours(places.size());
  for (std::size_t done = 0, count = 0; done < places.size(); done += count) {
    count = std::min(batch_.load(), places.size() - done);
    const auto begin = Clock::now();
    ask(&places[done], count, &colours[done]);
    if (seconds_since(begin) > 0.02)
      batch_ = std::max(count / 2, std::size_t(1));
    else if (seconds_since(begin) < 0.01 && count == batch_)
      batch_ = std::min(2 * count, largest);
  }
  return colours;
}

void OwnProgram::ask(const tyndall_book::pixel_place* places, std::size_t count, Vec3d* colours) {
  const std::size_t size = count * sizeof *places;
  const tyndall_book::message_head head{0, static_cast<double>(size)};
  std::string bytes(reinterpret_cast<const char*>(&head), sizeof head);
  bytes.append(reinterpret_cast<const char*>(places), size);
  for (std::size_t done = 0; done < bytes.size();)
    if (send_some(channel_, bytes.data(), bytes.size(), done) == Sent::closed)
      throw IoError(name_ + ": the program has ended");
  const std::optional<Message> message = next_message(20);
  stops_ = stops_ || !message;  // it has ended, or hangs
  if (!message || message->bytes.size() != count * sizeof *colours)
    throw IoError(name_ + ": the program has ended, or needs more than 20 s for a sample");
  std::memcpy(colours, message->bytes.data(), message->bytes.size());
}

const ChildEnd& OwnProgram::end() {
  stops_ = true;
  return end_.get();
}

}  // namespace tyndall
