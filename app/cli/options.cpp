#include "app/book/load_program.h"
#include "app/check/check.h"
#include "app/cli/requests.h"
#include "app/manual/page.h"
#include "app/text/standard_streams.h"
#include "core/base/text.h"
#include "core/render/clean_film.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <sstream>

/// Reads the command line. What Tyndall's commands add to CLI11: values that are read by functions which say what they
/// expected, so that every refusal reads alike ("--size: found "8", expected WIDTHxHEIGHT ..."), suggestions, and a
/// usage line of our own.
namespace tyndall {
namespace {

using Text = const std::string&;
using Arguments = const std::vector<std::string>&;
using Request = const CommandRequest&;

void add_option(CLI::App& app, const OptionRow& row, CommandRequest& request) {
  const auto take = [&](const std::string& text) {
    try {
      row.taker.take(request, text);
    } catch (const UsageError& error) {
      if (row.unit.empty() || row.names[0] != '-') throw;
      refuse("{}: {}", row.names.substr(row.names.find("--")), error.what());
    }
  };
  app.option_defaults()->group(row.heading);
  if (row.unit.empty()) {
    const auto on = [take] { take("on"); };
    app.add_flag_callback(row.names, on, row.help);
    return;
  }
  const auto each = [take](const std::vector<std::string>& texts) { std::for_each(texts.begin(), texts.end(), take); };
  CLI::Option* option = row.taker.each
                            ? app.add_option_function<std::vector<std::string>>(row.names, each, row.help)->take_all()
                            : app.add_option_function<std::string>(row.names, take, row.help);
  option->option_text(row.unit);
  if (row.names[0] == '-') option->allow_extra_args(false);
}

std::string help_text(const CLI::App& app, const CommandRow& command) {
  CLI::Formatter formatter;
  formatter.column_width(30);
  formatter.label("Positionals", "Arguments");
  std::string text = command.about + "\n\nUsage: tyndall " + command.usage + "\n" + formatter.make_positionals(&app) +
                     formatter.make_groups(&app, CLI::AppFormatMode::Normal) + "\n" + formatter.make_footer(&app);
  // CLI11 puts two empty lines between groups.
  for (auto at = text.find("\n\n\n"); at != std::string::npos; at = text.find("\n\n\n")) text.erase(at, 1);
  return text;
}

/// Throws for the first word that is neither option nor argument.
void refuse_extras(const CLI::App& app, const std::string& see) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  for (const std::string& argument : app.remaining()) {
    if (argument == "--") continue;  // words after this are no options
    if (argument.size() < 2 || argument[0] != '-') refuse("unexpected argument {}{}", in_quotes(argument), see);
    const std::string name = argument.substr(0, argument.find('='));
    refuse("unknown option {}{}{}", in_quotes(name), did_you_mean(name, {names.begin(), names.end()}), see);
  }
}

/// " (see tyndall render --help)".
std::string see_help(std::string_view command) { return " (see tyndall " + std::string(command) + " --help)"; }

/// Reads what follows a command. Returns the help if that is asked for. Throws UsageError, a line.
std::optional<std::string> parse(const CommandRow& command, std::vector<std::string> arguments,
                                 CommandRequest& request) {
  CLI::App app;
  app.set_help_flag("-h,--help", command.options.front().help);
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app.allow_extras();  // they are refused below, with a suggestion
  app.footer(command.examples);
  for (const OptionRow& row : command.arguments) add_option(app, row, request);
  for (const OptionRow& row : command.options)
    if (row.taker.take) add_option(app, row, request);
  const std::string see = see_help(command.name());
  std::reverse(arguments.begin(), arguments.end());  // what CLI11 expects
  try {
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    return help_text(app, command);
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string text = error.what();
    refuse("{}: a value is missing{}", text.substr(0, text.find(':')), see);
  } catch (const CLI::ParseError& error) {
    std::string text = error.what();
    std::replace(text.begin(), text.end(), '\n', ' ');
    refuse("{}{}", text, see);
  }
  refuse_extras(app, see);
  return std::nullopt;
}

/// A program may have further source files; nothing else takes more words than one.
void take_scene(CommandRequest& request, std::size_t at) {
  if (request.operands.size() <= at) return;
  request.scene.what = request.operands[at];
  request.scene.program.allowed = true;
  request.scene.program.differs = differs_from_own;
  for (std::size_t k = at + 1; k < request.operands.size(); ++k) {
    if (!is_program(request.operands[at]) || !is_program(request.operands[k]))
      refuse("unexpected argument {}{}", in_quotes(request.operands[k]), see_help(request.command));
    request.scene.program.sources.files.emplace_back(request.operands[k]);
  }
}

bool has_output(Request r) { return !r.output.empty(); }
bool has_outputs(Request r) { return !r.outputs.empty(); }
bool has_operands(Request r) { return !r.operands.empty(); }
bool has_baseline(Request r) { return !r.baseline.folder.empty(); }
bool has_reports(Request r) { return !r.report.empty() || !r.junit.empty(); }

/// What commands cannot do without.
struct Need {
  std::string_view commands;
  bool (*given)(Request);
  const char* what;
};
constexpr std::string_view of_scenes = "view render sweep animate chart inspect convert";
constexpr Need required[] = {
    {of_scenes, [](Request r) { return !r.scene.what.empty(); }, "SCENE"},
    {"render", [](Request r) { return r.replay || has_outputs(r); }, "an output (-o FILE)"},
    {"sweep", [](Request r) { return !r.axes.empty(); }, "a value to vary (--vary POINTER=FROM:TO:STEPS)"},
    {"sweep", [](Request r) { return !r.sheet.empty() || !r.csv.empty() || has_outputs(r); },
     "an output (-o SHEET.png)"},
    {"animate", [](Request r) { return has_outputs(r) || !r.video.empty(); }, "an output (-o 'f/%04d.png')"},
    {"compare", has_operands, "IMAGE"},
    {"compare", [](Request r) { return has_baseline(r) || r.operands.size() > 1; }, "REFERENCE"},
    {"chart", has_output, "an output (-o FILE.svg)"},
    {"merge", has_operands, "PART"},
    {"denoise", [](Request r) { return !r.image.empty(); }, "FILM.exr"},
    {"merge denoise", has_outputs, "an output (-o FILE)"},
    {"convert", has_output, "an output (-o FILE)"},
};

static_assert(min_clean_spp == 2);  // as a message says
/// Options that exclude each other, or need another one.
constexpr std::pair<bool (*)(Request), const char*> conflicts[] = {
    {[](Request r) { return has_baseline(r) && (!r.heatmap.empty() || r.json); },
     "--baseline goes with --report and --junit, not with --heatmap or --json"},
    {[](Request r) { return has_baseline(r) && r.update && has_reports(r); },
     "--update compares nothing, so it writes no report"},
    {[](Request r) { return !has_baseline(r) && (r.update || has_reports(r)); },
     "--update, --report and --junit need --baseline"},
    {[](Request r) { return r.command == "inspect" && !r.isa.empty() && !r.measure; },
     "--isa can only be given with --measure"},
    {[](Request r) { return r.replay && has_outputs(r); },
     "--replay and -o exclude each other: a replay writes no image"},
    {[](Request r) { return r.replay && r.form.ppm == PpmCurve::gamma2; },
     "--replay and --gamma2 exclude each other: a replay writes no image"},
    {[](Request r) { return r.replay && r.viewer; },
     "--replay and --watch-at exclude each other: a replay shows no image"},
    {[](Request r) { return r.clean && r.spp && *r.spp < min_clean_spp; },
     "--denoise: found --spp 1, expected at least 2 samples a pixel"},
    {[](Request r) { return r.fresh && r.resume; },
     "--fresh and --resume exclude each other: one starts over, one goes on"},
    {[](Request r) { return r.checkpoint > 0 && kept_film(r.outputs, r.form).empty(); },
     "--checkpoint needs an output that ends in .exr, and --exr-film yes"},
    {[](Request r) { return r.sample_range && r.clean; },
     "--samples and --denoise exclude each other: a part is filtered when it is merged"},
    {[](Request r) { return r.sample_range && r.spp; },
     "--samples and --spp exclude each other: --samples says which samples to take"},
    {[](Request r) { return r.sample_range && r.time_limit < 1e300; },
     "--samples and --time exclude each other: --samples says which samples to take"},
    {[](Request r) { return r.sample_range && r.target_error > 0; },
     "--samples and --target-error exclude each other: --samples says which samples to take"},
};

/// Puts the images where they belong.
void finish_compare(CommandRequest& request) {
  const std::vector<std::string>& images = request.operands;
  if (has_baseline(request)) return request.baseline.images.assign(images.begin(), images.end());
  take_scene(request, 1);
  request.image = images[0] == "-" ? "/dev/stdin" : images[0];
  request.reference = images[1];
}

/// Puts the words where they belong. Throws UsageError for what is missing, and for options that exclude each other.
void finish(CommandRequest& request) {
  const std::string_view name = request.command;
  if (of_scenes.find(name) != of_scenes.npos) take_scene(request, 0);
  for (const Need& need : required)
    if (need.commands.find(name) != need.commands.npos && !need.given(request))
      refuse("{} is missing{}", need.what, see_help(request.command));
  if (name == "compare") finish_compare(request);
  if (name == "chart" && request.scene.what != "all") read_file_name(request.output.string(), {".svg"});
  const std::vector<SweepAxis>& axes = request.axes;
  if (axes.size() > 2) refuse("--vary: found it {} times, expected it once or twice", axes.size());
  if (axes.size() == 2 && axes[0].pointer == axes[1].pointer)
    refuse("--vary: found {} twice, expected two values", in_quotes(axes[0].pointer));
  for (const auto& [found, text] : conflicts)
    if (found(request)) refuse("{}", text);
}

/// A command that prints a text.
CommandRequest printing(Text text) {
  CommandRequest request;
  request.text = text;
  request.run = [](Request r) { return write_standard_output(r.text), 0; };
  return request;
}

CommandRequest read(const CommandRow& row, Arguments arguments) {
  CommandRequest request;
  request.command = row.name();
  request.run = row.run;
  request.arguments = arguments;
  if (request.command != "view") request.scene.what.clear();
  if (const auto help = parse(row, arguments, request)) return printing(*help);
  finish(request);
  return request;
}

std::string overview() {
  std::string text =
      "Tyndall: an interactive, progressive path tracer for glass, brushed metal and fog.\n"
      "Usage: tyndall [SCENE] | tyndall COMMAND [options]\n\nCommands:\n";
  for (const CommandRow& command : command_rows()) text += fmt::format("  {:<10}{}\n", command.name(), command.summary);
  return text +
         "\nOptions:\n"
         "  -h, --help    show this text; 'tyndall COMMAND --help' shows that of a command\n"
         "  -V, --version show the version, the compiler, instruction sets and libraries\n"
         "  help man, help bash, help zsh, help fish: the manual's page; completion for a shell\n\n"
         "Exit codes: 0 done; 1 a check failed; 2 wrong usage or a scene that cannot be read;\n"
         "3 input, output or display error; 130 Ctrl-C; 128 and its number: another signal.\n";
}

/// Throws if a word that was not taken for a command must have been meant as one, or as an option of the program
/// itself.
void refuse_misspelt(Text argument, bool alone) {
  const std::string option = did_you_mean(argument, {"--version", "--help"});
  if (alone && argument.starts_with('-') && argument.size() > 2 && !option.empty())
    refuse("unknown option {}{} (see tyndall --help)", in_quotes(argument), option);
  std::vector<std::string> names;
  for (const CommandRow& command : command_rows()) names.push_back(command.name());
  const std::string hint = did_you_mean(argument, {names.begin(), names.end()});
  std::error_code error;
  const bool is_file = argument.find_first_of("./") != argument.npos || std::filesystem::exists(argument, error);
  if (!hint.empty() && argument[0] != '-' && !is_file) refuse("unknown command {}{}", in_quotes(argument), hint);
}

std::string manual_text(Arguments arguments) {
  if (arguments.empty()) return overview();
  constexpr std::string (*writers[])(const std::vector<CommandRow>&) = {man_page, bash_completion, zsh_completion,
                                                                        fish_completion};
  return writers[read_name(arguments[0], {"man", "bash", "zsh", "fish"})](command_rows());
}

}  // namespace

CommandRequest read_method(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos)
    refuse("found \"{}\", expected NAME=FLAGS, e.g. 'no MIS=--integrator nee'", text);
  CommandRequest method;
  method.curve = text.substr(0, equals);
  std::istringstream stream(text.substr(equals + 1));
  const std::vector<std::string> arguments{std::istream_iterator<std::string>(stream), {}};
  const auto rows =
      with_options({{"--method NAME=FLAGS", "", "One curve of a chart.", "", {{"Method", "{render} --isa"}}, nullptr}});
  if (parse(rows.front(), arguments, method)) refuse("found a question for help, expected flags of a method");
  return method;
}

CommandRequest read_command(const std::vector<std::string>& arguments) {
  const std::vector<CommandRow>& commands = command_rows();
  if (arguments.empty()) return read(commands.front(), {});
  const std::string& first = arguments.front();
  if (first == "-h" || first == "--help") return printing(overview());
  if (first == "help") return printing(manual_text({arguments.begin() + 1, arguments.end()}));
  if (first == "-V" || first == "--version" || first == "version") return printing(version_text());
  for (const CommandRow& command : commands)
    if (first == command.name()) return read(command, {arguments.begin() + 1, arguments.end()});
  if (first == "book" && !std::filesystem::exists(first))
    refuse(
        "book: the folder of headers is gone: programs are read with their own; in place of a build by hand: tyndall "
        "main.cc, tyndall render main.cc -o picture.exr, or ./mine | tyndall view -");
  refuse_misspelt(first, arguments.size() == 1);
  return read(commands.front(), arguments);
}

}  // namespace tyndall
