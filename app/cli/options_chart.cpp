#include "app/cli/options_render.h"

#include "core/base/thread_pool.h"

#include <sstream>

namespace tyndall {
namespace {

/// NAME=FLAGS, e.g. "no MIS=--integrator nee --isa avx2".
MethodRequest read_method(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos)
    throw UsageError("found \"" + text + "\", expected NAME=FLAGS, e.g. 'no MIS=--integrator nee'");
  MethodRequest method{text.substr(0, equals), {}, ""};
  std::istringstream stream(text.substr(equals + 1));
  std::vector<std::string> arguments;
  for (std::string argument; stream >> argument;) arguments.push_back(argument);
  const auto app = new_command("--method NAME=FLAGS", "One curve of a chart.");
  add_method_options(*app, method.scene);
  add_isa(*app, method.isa);
  if (parse(*app, arguments)) throw UsageError("found a question for help, expected flags of a method");
  return method;
}

}  // namespace

Command read_chart(const std::vector<std::string>& arguments) {
  ChartCommand command;
  command.scene.what.clear();
  const auto app =
      new_command("chart SCENE -o FILE.svg [options]",
                  "Charts speed against accuracy: relMSE over seconds of rendering, a curve for each method, against\n"
                  "a reference. Without --method: the books' method and each improvement switched on in turn. Writes\n"
                  "the chart, a CSV file beside it (method,spp,seconds,relmse), and prints a table. SCENE 'all' makes\n"
                  "a gallery of charts in the folder -o.",
                  "Examples:\n"
                  "  tyndall chart cornell-smoke -o smoke.svg\n"
                  "  tyndall chart fog.json --method 'mis=' --method 'no MIS=--integrator nee' -o fog.svg");
  add_scene(*app, command.scene);
  add_value(*app, "-o,--output", "FILE.svg", "the chart; required", [&](const std::string& t) { command.output = t; });
  add_values(*app, "--method", "NAME=FLAGS",
             "a curve: the scene's settings, and what its flags change\n"
             "(those of Method in 'tyndall render', and --isa); repeatable",
             [&](const std::string& t) { command.methods.push_back(read_method(t)); });
  add_value(*app, "--reference", "FILE",
            "image to measure errors against, of the same size; FILE.exr:LAYER\ntakes a layer of an EXR [rendered]",
            [&](const std::string& t) { command.reference = t; });
  add_value(*app, "--budget", "SECONDS", "time for all, the reference included [50]",
            [&](const std::string& t) { command.budget = read_number(t, above(0), "a number of seconds > 0"); });
  add_value(*app, "--size", "WxH", "image size in pixels [the scene's, made smaller to 65,536 pixels]",
            [&](const std::string& t) { command.scene.size = read_size(t); });
  add_value(*app, "-t,--threads", "N",
            "worker threads [the processors that this process may use:\naffinity, and quota rounded up]",
            [&](const std::string& t) { command.threads = static_cast<int>(read_whole(t, 1, max_threads)); });
  add_progress(*app, command.progress);
  if (auto help = parse(*app, arguments)) return PrintCommand{*help};
  require(*app, !command.scene.what.empty(), "SCENE");
  require(*app, !command.output.empty(), "an output (-o FILE.svg)");
  if (command.scene.what != "all") read_file_name(command.output.string(), ".svg");
  return command;
}

}  // namespace tyndall
