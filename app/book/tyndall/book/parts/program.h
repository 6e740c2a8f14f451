#pragma once
#include <cxxabi.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <typeinfo>

/// What the program says while it runs, and to whom. Under `tyndall main.cc` the caller reads messages from a pipe,
/// whose number is in TYNDALL_BOOK_PIPE: a letter (S: scene, N: note, R: refusal), the number of bytes, a line end, the
/// bytes. A program that was started by hand tells notes and refusals on standard error.
namespace tyndall_book {

/// The pipe's descriptor; -1: the program was started by hand.
inline int caller() {
  static const int pipe = [] {
    const char* number = std::getenv("TYNDALL_BOOK_PIPE");
    return number ? std::atoi(number) : -1;
  }();
  return pipe;
}

inline void tell_caller(char kind, const std::string& text) {
  const std::string message = kind + std::to_string(text.size()) + "\n" + text;
  for (std::size_t done = 0; done < message.size();) {
    const auto written = write(caller(), message.data() + done, message.size() - done);
    if (written <= 0) std::_Exit(3);
    done += static_cast<std::size_t>(written);
  }
}

/// Tells a sentence that the reader should know, and goes on.
inline void note(const std::string& text) {
  if (caller() >= 0)
    tell_caller('N', text);
  else
    std::fprintf(stderr, "tyndall: %s\n", text.c_str());
}

/// Ends the program: something cannot be taken over.
[[noreturn]] inline void refuse(const std::string& why) {
  std::fflush(nullptr);
  if (caller() >= 0)
    tell_caller('R', why);
  else
    std::fprintf(stderr, "tyndall: %s\n", why.c_str());
  std::_Exit(2);
}

/// The name of an object's class.
template <class T>
std::string class_of(const T& object) {
  int failed = 0;
  char* name = abi::__cxa_demangle(typeid(object).name(), nullptr, nullptr, &failed);
  const std::string text = name ? name : typeid(object).name();
  std::free(name);
  return text;
}

/// Whether both are of one class; the second may be of a class derived from the first one's.
template <class T, class U>
bool of_class(const U& object) {
  return typeid(object) == typeid(T);
}

}  // namespace tyndall_book
