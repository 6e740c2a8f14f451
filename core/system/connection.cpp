#include "core/system/connection.h"

#include <sys/socket.h>
#include <netdb.h>
#include <poll.h>

#include <cerrno>
#include <chrono>
#include <memory>

namespace tyndall {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int moment = 50;  // milliseconds
constexpr auto connect_time = std::chrono::seconds(10);
constexpr int send_buffer = 1 << 18;  // small, so that it shows soon that the other side does not read

bool is_for_now(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

bool takes_bytes(int socket) {
  pollfd watched{socket, POLLOUT, 0};
  return poll(&watched, 1, moment) > 0;
}

OpenFile connect_at(const addrinfo& to, const std::function<bool()>& go_on, std::string& why) {
  const auto fail = [&why](const std::string& text) {
    why = text;
    return OpenFile();
  };
  OpenFile made(socket(to.ai_family, to.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, to.ai_protocol));
  int error = 0, buffer = send_buffer;
  setsockopt(made.descriptor(), SOL_SOCKET, SO_SNDBUF, &buffer, sizeof buffer);
  if (!made || (connect(made.descriptor(), to.ai_addr, to.ai_addrlen) != 0 && errno != EINPROGRESS))
    return fail(error_text(errno));
  for (const auto start = Clock::now(); !takes_bytes(made.descriptor());) {
    if (!go_on()) return {};
    if (Clock::now() - start >= connect_time) return fail("no answer within 10 s");
  }
  socklen_t size = sizeof error;
  if (getsockopt(made.descriptor(), SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == 0) return made;
  return fail(error_text(error));
}

}  // namespace

OpenFile connect_to(const std::string& host, const std::string& port, const std::function<bool()>& go_on,
                    std::string& why) {
  addrinfo hints{}, *first = nullptr;
  hints.ai_family = AF_UNSPEC, hints.ai_socktype = SOCK_STREAM;
  if (const int error = getaddrinfo(host.c_str(), port.c_str(), &hints, &first); error != 0) {
    why = gai_strerror(error);
    return {};
  }
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> list(first, freeaddrinfo);
  OpenFile made;
  for (const addrinfo* address = first; address && !made && go_on(); address = address->ai_next)
    made = connect_at(*address, go_on, why);
  return made;
}

std::pair<OpenFile, OpenFile> connected_pair() {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return {};
  return {OpenFile(ends[0]), OpenFile(ends[1])};
}

Sent send_some(const OpenFile& to, const char* bytes, std::size_t size, std::size_t& done) {
  const ssize_t sent = send(to.descriptor(), bytes + done, size - done, MSG_NOSIGNAL);
  if (sent > 0) done += static_cast<std::size_t>(sent);
  if (sent > 0) return Sent::some;
  if (sent < 0 && !is_for_now(errno)) return Sent::closed;
  takes_bytes(to.descriptor());
  return Sent::none;
}

bool is_closed_by_other(const OpenFile& connection) {
  char ignored[256];
  const ssize_t got = recv(connection.descriptor(), ignored, sizeof ignored, MSG_DONTWAIT);
  return got == 0 || (got < 0 && !is_for_now(errno));
}

bool receive(const OpenFile& from, void* to, std::size_t size, int milliseconds) {
  for (char* at = static_cast<char*>(to); size > 0;) {
    if (milliseconds > 0 && !has_bytes(from.descriptor(), milliseconds)) return false;
    const ssize_t got = recv(from.descriptor(), at, size, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    at += got, size -= static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace tyndall
