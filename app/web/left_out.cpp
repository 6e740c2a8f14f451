// What a page does not do, in the words of the rest: nobody else writes its files, and it compiles no programs.
#include "app/book/load_program.h"
#include "core/system/file_watch.h"

namespace tyndall {

FileWatch::FileWatch(const std::vector<std::filesystem::path>&, std::function<void()>) {}
FileWatch::~FileWatch() = default;

bool is_program(const std::string&) { return false; }

}  // namespace tyndall
