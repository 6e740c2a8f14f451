#pragma once
#include "app/window/document/message.h"
#include "app/window/panels/context.h"
#include "app/window/panels/widgets.h"

#include <string>
#include <vector>

/// What is drawn over and beneath the picture: status line, messages, help table.
namespace tyndall {

/// A part of the status line: a grey word and a value.
struct StatusCell {
  std::string key, value;
  int rank = 0;  ///< the cells of the highest rank go first when there is no room
  bool warning = false;
};

/// The parts for a state of things.
std::vector<StatusCell> status_cells(const Context& context, const Scene& scene);

/// Which cells fit: drops those of the highest rank, last ones first, until the rest is at most `room` wide.
std::vector<std::size_t> fitting_cells(const std::vector<StatusCell>& cells, const std::vector<float>& widths,
                                       float room);

void draw_status(Ui& ui, const Rect& rect, const std::vector<StatusCell>& cells);

/// A box above the status line.
void draw_message(Ui& ui, const Rect& area, const Message& message);

/// The table of inputs; sets `open` to false when it is clicked away.
void draw_help(Ui& ui, bool& open);

}  // namespace tyndall
