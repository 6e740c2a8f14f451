#pragma once
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

/// This process: its standard streams, its memory pages, its priority. What it may use: see processors.h.
namespace tyndall {

/// Call first. Where the caller closed one of the standard streams, the next file that the program opens would get its
/// number, and messages would end up in that file: it gets one to which writing fails. Writing beyond a limit of file
/// sizes fails from now on, too, and ends the program no more.
void begin_process();

/// What main() got, without the program's name, in UTF-8.
std::vector<std::string> program_arguments(int argc, char** argv);

/// Whether a variable of the environment is there and not empty, such as NO_COLOR and DISPLAY.
inline bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value;
}

bool is_terminal(int descriptor);
/// Whether standard error is a terminal that has colours and can draw a line again.
bool has_smart_terminal();
/// Columns of the terminal that standard error is; 80 if it does not say.
int terminal_columns();
inline constexpr int standard_error = 2;
/// Whether there is a display on which a window could be opened.
bool has_display();

/// Memory that large pages have, on x86-64 and, usually, on ARM.
inline constexpr std::size_t large_page = std::size_t{2} << 20;
/// A wish: where it is refused, the memory is as good. begin: on a large page.
void ask_for_large_pages(void* begin, std::size_t bytes);
/// Memory for std::free(); null: there is none.
void* allocate_aligned(std::size_t bytes, std::size_t alignment);

/// From now on the calling thread, and those that it starts, give way to others, as "nice" does. (On Linux a priority
/// belongs to one thread, which cannot take it back; elsewhere this changes nothing.)
void lower_priority(int niceness);
/// Seconds of processor time that the calling thread has used; where the system cannot say that, seconds that passed.
double thread_cpu_seconds();

/// A function of a library that another part of the program has loaded; null: it has not.
void* loaded_function(const char* library, const char* name);

}  // namespace tyndall
