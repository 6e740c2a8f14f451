#include "app/book/own_program.h"

#include "core/base/error.h"

#include <utility>

namespace tyndall {

OwnProgram::OwnProgram(std::string name, ChildPlan plan, double seconds, std::function<bool()> go_on)
    : name_(std::move(name)), go_on_(std::move(go_on)) {
  auto [mine, its] = connected_pair();
  if (!mine) throw IoError(name_ + ": cannot be run: too many files are open");
  channel_ = std::move(mine);
  plan.channel = its.descriptor();
  plan.environment.push_back("TYNDALL_BOOK_CHANNEL=" + std::to_string(plan.channel));
  plan.seconds = 1e9;
  set_deadline(seconds);
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

void OwnProgram::set_deadline(double seconds) {
  const std::lock_guard lock(wanted_mutex_);
  deadline_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(static_cast<long>(1000 * seconds));
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
  tyndall_book::question head;
  constexpr double largest = 300.0 * (1 << 20);  // more than any object's or picture's
  if (!receive(channel_, &head, sizeof head) || !(head.count >= 0 && head.count <= largest)) return {};
  Message message{static_cast<char>(head.letter), std::string(static_cast<std::size_t>(head.count), 0)};
  if (!receive(channel_, message.text.data(), message.text.size())) return {};
  return message;
}

void OwnProgram::send(const void* bytes, std::size_t size) {
  for (std::size_t done = 0; done < size;)
    if (send_some(channel_, static_cast<const char*>(bytes), size, done) == Sent::closed)
      throw IoError(name_ + ": the program has ended");
}

void OwnProgram::exchange(const tyndall_book::question& head, const void* question, std::size_t question_size,
                          void* answer, std::size_t answer_size) {
  const std::lock_guard lock(mutex_);
  send(&head, sizeof head), send(question, question_size);
  constexpr int longest = 20000;
  if (receive(channel_, answer, answer_size, longest)) return;
  stops_ = true;  // it has ended, or hangs
  throw IoError(name_ + ": the program has ended, or needs more than 20 s for a sample");
}

std::vector<double> OwnProgram::samples(const std::vector<double>& places) {
  std::vector<double> colours(places.size() / 2 * 3);
  const double count = static_cast<double>(places.size()) / 2;
  exchange({'p', 0, count, count}, places.data(), places.size() * sizeof(double), colours.data(),
           colours.size() * sizeof(double));
  return colours;
}

std::string OwnProgram::describe(char kind, const std::vector<double>& objects) {
  const std::lock_guard lock(mutex_);
  const tyndall_book::question head{double(kind), 0, static_cast<double>(objects.size())};
  send(&head, sizeof head), send(objects.data(), objects.size() * sizeof(double));
  const std::optional<Message> message = next_message();
  if (!message) throw IoError(name_ + ": the program has ended");
  return message->text;
}

const ChildEnd& OwnProgram::end() {
  stops_ = true;
  if (thread_.joinable()) thread_.join();
  return end_;
}

}  // namespace tyndall
