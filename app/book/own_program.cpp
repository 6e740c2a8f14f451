#include "app/book/own_program.h"

#include "core/base/error.h"

#include <sys/socket.h>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

namespace tyndall {

OwnProgram::OwnProgram(std::string name, ChildPlan plan, double seconds, std::function<bool()> go_on)
    : name_(std::move(name)), go_on_(std::move(go_on)) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw IoError(name_ + ": cannot be run: " + std::generic_category().message(errno));
  channel_ = ends[0];
  plan.channel = ends[1], plan.channel_variable = "TYNDALL_BOOK_CHANNEL";
  plan.seconds = 1e9;
  deadline_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(static_cast<long>(1000 * seconds));
  plan.go_on = [this] { return !stops_ && is_wanted(); };
  thread_ = std::thread([this, plan = std::move(plan)] {
    end_ = run_child(plan);
    close(plan.channel);
  });
}

OwnProgram::~OwnProgram() {
  stops_ = true;
  if (thread_.joinable()) thread_.join();
  close(channel_);
}

void OwnProgram::set_lasting() {
  const std::lock_guard lock(wanted_mutex_);
  go_on_ = nullptr;
}

bool OwnProgram::is_wanted() {
  const std::lock_guard lock(wanted_mutex_);
  return !go_on_ || (go_on_() && std::chrono::steady_clock::now() < deadline_);
}

bool OwnProgram::receive(void* to, std::size_t size, int milliseconds) const {
  for (char* at = static_cast<char*>(to); size > 0;) {
    pollfd polled{channel_, POLLIN, 0};
    if (milliseconds > 0 && poll(&polled, 1, milliseconds) == 0) return false;
    const ssize_t got = recv(channel_, at, size, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got, size -= static_cast<std::size_t>(got);
  }
  return true;
}

std::optional<OwnProgram::Message> OwnProgram::next_message() {
  Message message;
  std::string size;
  char letter = 0;
  if (!receive(&message.kind, 1)) return {};
  while (receive(&letter, 1) && letter != '\n' && size.size() < 12) size += letter;
  constexpr std::size_t largest = std::size_t(300) << 20;  // more than the largest scene
  const std::size_t bytes = std::strtoull(size.c_str(), nullptr, 10);
  if (letter != '\n' || bytes > largest) return {};
  message.text.resize(bytes);
  if (!receive(message.text.data(), bytes)) return {};
  return message;
}

std::vector<double> OwnProgram::samples(const std::vector<double>& places) {
  const std::lock_guard lock(mutex_);
  const std::uint64_t count = places.size() / 2;
  std::vector<double> colours(3 * count);
  std::string question(sizeof count + places.size() * sizeof(double), 0);
  std::memcpy(question.data(), &count, sizeof count);
  std::memcpy(question.data() + sizeof count, places.data(), places.size() * sizeof(double));
  for (std::size_t done = 0; done < question.size();) {
    const ssize_t sent = send(channel_, question.data() + done, question.size() - done, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) throw IoError(name_ + ": the program has ended");
    done += static_cast<std::size_t>(sent);
  }
  constexpr int longest = 20000;
  if (receive(colours.data(), colours.size() * sizeof(double), longest)) return colours;
  stops_ = true;  // it has ended, or hangs
  throw IoError(name_ + ": the program has ended, or needs more than 20 s for a sample");
}

const ChildEnd& OwnProgram::end() {
  stops_ = true;
  if (thread_.joinable()) thread_.join();
  return end_;
}

}  // namespace tyndall
