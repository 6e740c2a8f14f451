#pragma once
#include "maths.h"
#include "program.h"

#include <cctype>
#include <iostream>
#include <mutex>
#include <streambuf>
#include <string>

namespace tyndall_book {

/// Told when main() has written the three numbers of a pixel on standard output, each a share of the largest.
void take_written_pixel(const vec3& fractions);

/// Reads what main() writes by std::cout. Text goes on to standard output; a picture that begins (P3) does not: of that
/// the size is kept, and its pixels are told.
class OutputSpy : public std::streambuf {
 public:
  static OutputSpy& get() {
    static OutputSpy spy;
    return spy;
  }
  ~OutputSpy() override {
    sync();
    std::cout.rdbuf(before_);
  }
  /// Of the picture; 0: none has begun.
  int width() const { return header_ > 1 ? static_cast<int>(size_[0]) : 0; }
  int height() const { return header_ > 1 ? static_cast<int>(size_[1]) : 0; }

 protected:
  int_type overflow(int_type c) override {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    if (!traits_type::eq_int_type(c, traits_type::eof())) put(traits_type::to_char_type(c));
    return traits_type::not_eof(c);
  }
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    for (std::streamsize k = 0; k < size; ++k) put(text[k]);
    return size;
  }
  int sync() override {
    const std::lock_guard<std::recursive_mutex> lock(mutex_);
    const bool may_begin = token_ == "P" || token_ == "P3";
    if (!in_picture_ && !may_begin) send();
    return before_->pubsync();
  }

 private:
  OutputSpy() : before_(std::cout.rdbuf(this)) {}

  void send() {
    before_->sputn(token_.data(), static_cast<std::streamsize>(token_.size()));
    token_.clear();
  }
  void put(char c) {
    const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!in_picture_) {
      if (blank && token_ == "P3") {
        in_picture_ = true;
        token_.clear();
        return;
      }
      token_ += c;
      if (blank) send();
      return;
    }
    if (c == '#') in_comment_ = true;
    if (c == '\n') in_comment_ = false;
    if (!blank && !in_comment_) token_ += c;
    if (blank && !token_.empty()) take_token();
  }
  void take_token() {
    char* end = nullptr;
    const double value = std::strtod(token_.c_str(), &end);
    const bool is_number = *end == '\0';
    token_.clear();
    if (!is_number) return;
    if (header_ < 3) {
      size_[header_++] = value;
      return;
    }
    pixel_[channel_++] = value > 0 ? (value + 0.5) / (size_[2] + 1) : 0;
    if (channel_ < 3) return;
    channel_ = 0;
    take_written_pixel(pixel_);
  }

  std::streambuf* before_;
  std::recursive_mutex mutex_;  ///< threads of main() may write at once
  std::string token_;
  bool in_picture_ = false, in_comment_ = false;
  int header_ = 0, channel_ = 0;  ///< numbers read, of the header and of a pixel
  double size_[3] = {0, 0, 0};    ///< width, height, largest number
  vec3 pixel_;
};

/// Reads from std::cin end the program: what it would do with other input is not known.
class InputGuard : public std::streambuf {
 public:
  static InputGuard& get() {
    static InputGuard guard;
    return guard;
  }
  ~InputGuard() override { std::cin.rdbuf(before_); }

 protected:
  int_type underflow() override { refuse("main() reads standard input, which tyndall does not pass on"); }

 private:
  InputGuard() : before_(std::cin.rdbuf(this)) {}
  std::streambuf* before_;
};

}  // namespace tyndall_book
