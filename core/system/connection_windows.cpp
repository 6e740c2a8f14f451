#include "core/system/connection.h"

#include <cerrno>

namespace tyndall {

std::optional<Connection> Connection::to(const std::string&, const std::string&, const std::function<bool()>&,
                                         std::string& why) {
  why = error_text(ENOSYS);
  return {};
}

std::pair<Connection, Connection> Connection::pair() { return {}; }
Connection::Sent Connection::send(const char*, std::size_t, std::size_t&) const { return Sent::closed; }
bool Connection::is_closed_by_other() const { return true; }
bool Connection::receive(void*, std::size_t, int) const { return false; }

}  // namespace tyndall
