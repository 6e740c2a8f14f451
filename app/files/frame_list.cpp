#include "app/files/frame_list.h"

#include "core/base/error.h"
#include "core/system/open_file.h"

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
  const OpenFile list(file_, OpenFor::adding);
  int problem = list ? list.write(line.data(), line.size()) : list.error();
  if (problem == 0) problem = list.synchronise();
  if (problem != 0) throw IoError(file_.string() + ": cannot write: " + error_text(problem));
  entries_[frame] = entry;
}

}  // namespace tyndall
