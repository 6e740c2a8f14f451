#pragma once
#include "app/book/program_outline.h"

#include <string>

namespace tyndall {

/// A program with calls into tyndall/book/hooks.h in its functions, and behind it what tells our headers the names of
/// his classes. Nothing else of it changes.
struct InsertedCalls {
  std::string text;
  std::string problem;          ///< why there is nothing to be asked; "": there is
  bool draws_by_pdf = false;    ///< scatter() answers by densities, as the third book's does
  bool decodes_images = false;  ///< it lets its library decode images
};

/// text: preprocessed, its outline; see there. reads_world: whether the reader's world is looked at, which needs to
/// know more of his classes than samples do.
InsertedCalls insert_calls(const std::string& text, const ProgramOutline& outline, bool reads_world);

}  // namespace tyndall
