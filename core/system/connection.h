#pragma once
#include "core/system/open_file.h"

#include <cstddef>
#include <functional>
#include <string>
#include <utility>

/// Connections to other programs. No function waits for them longer than it says.
namespace tyndall {

/// To a program that listens, at the first of its host's addresses that answers, for each of which this waits 10 s; not
/// open, and why, if there is none. go_on: asked now and then; false ends the waiting.
OpenFile connect_to(const std::string& host, const std::string& port, const std::function<bool()>& go_on,
                    std::string& why);
/// Two ends of one connection; not open if the system has no more.
std::pair<OpenFile, OpenFile> connected_pair();

/// What sending has come to.
enum class Sent { some, none, closed };
/// Sends what is taken at once. Where that is nothing, waits a moment; `done` grows by what was sent.
Sent send_some(const OpenFile& to, const char* bytes, std::size_t size, std::size_t& done);
/// Throws away what has come; whether the other side has closed the connection.
bool is_closed_by_other(const OpenFile& connection);
/// All bytes; false: the other side has closed it, or has sent nothing for so long; 0: as long as it takes.
bool receive(const OpenFile& from, void* to, std::size_t size, int milliseconds = 0);

}  // namespace tyndall
