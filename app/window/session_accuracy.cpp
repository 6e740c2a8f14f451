#include "app/window/chart_export.h"
#include "app/window/open_document.h"
#include "app/window/session.h"
#include "app/window/snapshot.h"

#include <exception>
#include <utility>

/// The part of Session that is about errors.
namespace tyndall {

namespace fs = std::filesystem;

void Session::export_chart() {
  const std::vector<NamedRun> runs = named_runs(convergence_, nullptr);
  const std::string& title = document().origin->title;
  Chart chart = live_chart(runs, stem_of(title) + ": estimated error",
                           std::to_string(scene().width) + "x" + std::to_string(scene().height) + ", " +
                               std::to_string(threads_) + (threads_ == 1 ? " thread" : " threads") +
                               "; estimated from two halves of each pixel");
  if (chart.curves.empty()) return say("there is no curve yet");
  const fs::path base = numbered_base(fs::current_path(), stem_of(title) + "-chart", charts_ + 1, {".csv", ".svg"});
  charts_ = number_of(base);
  saving_.run([this, chart = std::move(chart), base]() -> JobQueue::Result {
    try {
      const std::string text = write_chart(chart, base);
      return [this, text, base] {
        say(text);
        if (log_) log_->line("saved " + base.string());
      };
    } catch (const std::exception& error) {
      return [this, text = std::string(error.what())] { say(text, true); };
    }
  });
}

}  // namespace tyndall
