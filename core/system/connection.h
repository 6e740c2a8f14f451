#pragma once
#include "core/system/open_file.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace tyndall {

/// A connection to another program. No function waits for it longer than it says.
class Connection {
 public:
  Connection() = default;
  /// To a program that listens, at the first of its host's addresses that answers, for each of which this waits 10 s;
  /// none, and why, if there is none. go_on: asked now and then; false ends the waiting.
  static std::optional<Connection> to(const std::string& host, const std::string& port,
                                      const std::function<bool()>& go_on, std::string& why);
  /// Two ends of one connection; not connected if the system has no more.
  static std::pair<Connection, Connection> pair();

  explicit operator bool() const { return static_cast<bool>(socket_); }
  int descriptor() const { return socket_.descriptor(); }
  int error() const { return socket_.error(); }
  void close() { socket_.close(); }

  /// What sending has come to.
  enum class Sent { some, none, closed };
  /// Sends what is taken at once. Where that is nothing, waits a moment; `done` grows by what was sent.
  Sent send(const char* bytes, std::size_t size, std::size_t& done) const;
  /// Throws away what has come; whether the other side has closed the connection.
  bool is_closed_by_other() const;
  /// All bytes; false: the other side has closed it, or has sent nothing for so long; 0: as long as it takes.
  bool receive(void* to, std::size_t size, int milliseconds = 0) const;

 private:
  explicit Connection(OpenFile socket) : socket_(std::move(socket)) {}

  OpenFile socket_;
};

}  // namespace tyndall
