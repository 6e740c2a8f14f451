#include "app/files/frame_list.h"

#include "core/base/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

namespace tyndall {

FrameList::FrameList(std::filesystem::path file) : file_(std::move(file)) {
  std::ifstream in(file_);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    int frame = 0;
    std::string state, mark, more;
    const bool read = static_cast<bool>(words >> frame >> state >> mark) && !(words >> more);
    if (read && mark.size() == 16 && (state == "begun" || state == "whole")) entries_[frame] = {mark, state == "whole"};
  }
}

const FrameList::Entry* FrameList::find(int frame) const {
  const auto found = entries_.find(frame);
  return found == entries_.end() ? nullptr : &found->second;
}

void FrameList::add(int frame, const Entry& entry) {
  // A line break in front ends a line that a kill has cut off.
  const std::string line = "\n" + std::to_string(frame) + (entry.whole ? " whole " : " begun ") + entry.mark + "\n";
  const int descriptor = open(file_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  const bool written = descriptor >= 0 &&
                       write(descriptor, line.data(), line.size()) == static_cast<ssize_t>(line.size()) &&
                       fsync(descriptor) == 0;
  const int why = errno;
  if (descriptor >= 0) close(descriptor);
  if (!written) throw IoError(file_.string() + ": cannot write: " + std::strerror(why));
  entries_[frame] = entry;
}

}  // namespace tyndall
