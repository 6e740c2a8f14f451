#include "app/book/own_program.h"

#include "core/base/error.h"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace tyndall {

OwnProgram::OwnProgram(std::string name, ChildPlan plan, double seconds, std::function<bool()> go_on)
    : name_(std::move(name)), go_on_(std::move(go_on)) {
  auto [mine, its] = Connection::pair();
  if (!mine) throw IoError(name_ + ": cannot be run: too many files are open");
  channel_ = std::move(mine);
  plan.channel = its.descriptor(), plan.channel_variable = "TYNDALL_BOOK_CHANNEL";
  plan.seconds = 1e9;
  deadline_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(static_cast<long>(1000 * seconds));
  plan.go_on = [this] { return !stops_ && is_wanted(); };
  thread_ = std::thread([this, plan = std::move(plan), its = std::move(its)]() mutable {
    end_ = run_child(plan);
    its.close();
  });
}

OwnProgram::~OwnProgram() {
  stops_ = true;
  if (thread_.joinable()) thread_.join();
}

void OwnProgram::set_lasting() {
  const std::lock_guard lock(wanted_mutex_);
  go_on_ = nullptr;
}

bool OwnProgram::is_wanted() {
  const std::lock_guard lock(wanted_mutex_);
  return !go_on_ || (go_on_() && std::chrono::steady_clock::now() < deadline_);
}

std::optional<OwnProgram::Message> OwnProgram::next_message() {
  Message message;
  std::string size;
  char letter = 0;
  if (!channel_.receive(&message.kind, 1)) return {};
  while (channel_.receive(&letter, 1) && letter != '\n' && size.size() < 12) size += letter;
  constexpr std::size_t largest = std::size_t(300) << 20;  // more than the largest scene
  const std::size_t bytes = std::strtoull(size.c_str(), nullptr, 10);
  if (letter != '\n' || bytes > largest) return {};
  message.text.resize(bytes);
  if (!channel_.receive(message.text.data(), bytes)) return {};
  return message;
}

std::vector<double> OwnProgram::samples(const std::vector<double>& places) {
  const std::lock_guard lock(mutex_);
  const std::uint64_t count = places.size() / 2;
  std::vector<double> colours(3 * count);
  std::string question(sizeof count + places.size() * sizeof(double), 0);
  std::memcpy(question.data(), &count, sizeof count);
  std::memcpy(question.data() + sizeof count, places.data(), places.size() * sizeof(double));
  for (std::size_t done = 0; done < question.size();)
    if (channel_.send(question.data(), question.size(), done) == Connection::Sent::closed)
      throw IoError(name_ + ": the program has ended");
  constexpr int longest = 20000;
  if (channel_.receive(colours.data(), colours.size() * sizeof(double), longest)) return colours;
  stops_ = true;  // it has ended, or hangs
  throw IoError(name_ + ": the program has ended, or needs more than 20 s for a sample");
}

const ChildEnd& OwnProgram::end() {
  stops_ = true;
  if (thread_.joinable()) thread_.join();
  return end_;
}

}  // namespace tyndall
