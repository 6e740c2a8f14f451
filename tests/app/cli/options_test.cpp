#include "app/cli/requests.h"

#include <doctest/doctest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace tyndall::test::options_test {

namespace {

using Arguments = std::vector<std::string>;

CommandRequest render_request(const Arguments& more) {
  Arguments arguments = {"render", "box.json", "-o", "a.png"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return std::get<CommandRequest>(read_command(arguments));
}

std::string refusal(const Arguments& arguments) {
  try {
    read_command(arguments);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

std::string printed(const Arguments& arguments) { return std::get<PrintCommand>(read_command(arguments)).text; }

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("without a command: the window") {
  CHECK(std::get<CommandRequest>(read_command({})).scene.what == "showroom");
  CHECK(std::get<CommandRequest>(read_command({"cornell-box"})).scene.what == "cornell-box");
  CHECK(std::get<CommandRequest>(read_command({"view"})).scene.what == "showroom");
  CHECK(std::get<CommandRequest>(read_command({"-"})).scene.what == "-");
  CHECK(std::get<CommandRequest>(read_command({"a.json", "--reference", "b.exr"})).reference == "b.exr");
  const auto view = std::get<CommandRequest>(read_command({"--seed", "7", "a.json", "-t", "2"}));
  CHECK(view.scene.what == "a.json");
  CHECK(view.scene.render.values.seed == 7u);
  CHECK(view.threads == 2);
}

TEST_CASE("programs: more source files and folders of headers, and leave to compile what was named") {
  const auto render = std::get<CommandRequest>(
      read_command({"render", "main.cc", "-I", "a", "b.cpp", "c.cxx", "-Id", "--include", "e", "-o", "x.png"}));
  const ProgramParts& parts = render.scene.program;
  CHECK(render.scene.what == "main.cc");
  CHECK(parts.sources.files == std::vector<std::filesystem::path>{"b.cpp", "c.cxx"});
  CHECK(parts.sources.include_folders == std::vector<std::filesystem::path>{"a", "d", "e"});
  CHECK(parts.allowed);
  CHECK(std::get<CommandRequest>(read_command({"main.cc"})).scene.program.allowed);
  CHECK_FALSE(std::get<CommandRequest>(read_command({})).scene.program.allowed);
  CHECK_FALSE(parts.trusted);
  CHECK(std::get<CommandRequest>(read_command({"inspect", "main.cc", "--trust"})).scene.program.trusted);
  CHECK_FALSE(std::get<CommandRequest>(read_command({"verify"})).scene.program.allowed);
  for (const Arguments& arguments :
       {Arguments{"inspect", "main.cc", "a.json"}, Arguments{"inspect", "a.json", "main.cc"}})
    CHECK(refusal(arguments) == "unexpected argument \"" + arguments[2] + "\" (see tyndall inspect --help)");
}

TEST_CASE("the window takes limits, at which the picture pauses") {
  const auto view = std::get<CommandRequest>(
      read_command({"view", "a.json", "--spp", "16", "--time", "2.5", "--target-error", "0.02"}));
  CHECK(view.scene.render.values.spp == 16);
  CHECK(view.scene.render.given.contains("spp"));
  CHECK(view.time_limit == 2.5);
  CHECK(view.target_error == 0.02);
  CHECK(has(refusal({"view", "--time", "0"}), "--time: found \"0\", expected a number of seconds > 0"));
}

TEST_CASE("the help of view, compare and inspect has examples, which are read") {
  for (const char* name : {"view", "compare", "inspect"}) {
    const std::string help = printed({name, "--help"});
    std::size_t at = help.find("Examples:\n");
    REQUIRE_MESSAGE(at != std::string::npos, name);
    int count = 0;
    for (at = help.find("  tyndall ", at); at != std::string::npos; at = help.find("  tyndall ", at + 1), ++count) {
      Arguments arguments;
      std::istringstream line(help.substr(at + 10, help.find('\n', at) - at - 10));
      for (std::string argument; line >> argument;) arguments.push_back(argument);
      CHECK_MESSAGE(refusal(arguments).empty(), help.substr(at, 60));
    }
    CHECK(count == (std::string_view(name) == "compare" ? 4 : 3));
  }
}

TEST_CASE("render: every option arrives") {
  const CommandRequest c = render_request(
      {"-o",           "b.exr",       "--size",     "64x32",          "--spp",      "16",           "--time",
       "2.5",          "--max-depth", "7",          "--sampler",      "random",     "--integrator", "path",
       "--fresnel",    "schlick",     "--exposure", "-1.5",           "--tone-map", "aces",         "--seed",
       "4294967295",   "--region",    "1,2,3,4",    "--isa",          "scalar",     "--stats",      "s.json",
       "--resume",     "-t",          "3",          "--target-error", "0.01",       "--progress",   "plain",
       "--checkpoint", "90"});
  CHECK(c.scene.what == "box.json");
  CHECK(c.outputs == std::vector<std::filesystem::path>{"a.png", "b.exr"});
  CHECK(c.scene.size->width == 64);
  CHECK(c.scene.size->height == 32);
  CHECK(c.spp == 16u);
  CHECK(c.time_limit == 2.5);
  CHECK(c.target_error == 0.01);
  CHECK(c.scene.render.values.max_depth == 7);
  CHECK(c.scene.render.values.sampler == SamplerKind::random);
  CHECK(c.scene.render.values.integrator == Integrator::path);
  CHECK(c.scene.render.values.fresnel == FresnelKind::schlick);
  CHECK(c.scene.display.values.exposure == -1.5);
  CHECK(c.scene.display.values.tone_map == ToneMap::aces);
  CHECK(c.scene.render.values.seed == 4294967295u);
  CHECK(c.region == Region{1, 2, 3, 4});
  CHECK(c.isa == "scalar");
  CHECK(c.stats == "s.json");
  CHECK(c.resume);
  CHECK_FALSE(c.fresh);
  CHECK(c.checkpoint == 90.0);
  CHECK(render_request({"--fresh"}).fresh);
  CHECK(c.threads == 3);
  CHECK(c.progress == ProgressStyle::plain);
}

TEST_CASE("every option of every command takes a value of its kind, by each of its names") {
  const std::map<std::string, std::string> values{{"", ""},
                                                  {"N", "7"},
                                                  {"X", "0.5"},
                                                  {"Z", "4"},
                                                  {"E", "0.1"},
                                                  {"EV", "1"},
                                                  {"on|off", "on"},
                                                  {"yes|no", "no"},
                                                  {"WxH", "4x3"},
                                                  {"A:B", "0:4"},
                                                  {"X0,Y0,X1,Y1", "0,0,1,1"},
                                                  {"DIR", "a"},
                                                  {"SECONDS", "2"},
                                                  {"FILE", "-"},
                                                  {"SHEET.png", "a.png"},
                                                  {"X,Y,SAMPLE", "1,2,3"},
                                                  {"NAME=FLAGS", "a=--seed 3"},
                                                  {"HOST[:PORT]", "localhost"},
                                                  {"POINTER=VALUE", "/a=1"},
                                                  {"POINTER=VALUES", "/a=1:2:3"}};
  int options = 0;
  for (const char* command : {"view", "render", "sweep", "animate", "compare", "chart", "verify", "merge", "denoise",
                              "inspect", "scenes", "convert"}) {
    const auto help = std::get<PrintCommand>(read_command({command, "--help"}));
    for (const OptionPage& option : help.page.options) {
      if (option.names.back() == "--help" || option.group.empty()) continue;
      std::string value = option.choices.empty() ? "" : option.choices.front();
      if (value.empty() && option.unit.starts_with("FILE.")) value = "a" + option.unit.substr(4);
      if (value.empty() && option.unit == "NAME") value = option.names.back() == "--each" ? "%v.png" : "%d.json";
      if (value.empty()) value = values.at(option.unit);
      for (const std::string& name : option.names) {
        Arguments arguments{command, name};
        if (!value.empty()) arguments.push_back(value);
        const std::string text = refusal(arguments);
        CHECK_MESSAGE((text.empty() || has(text, " is missing (see ") || has(text, " need --baseline")), text);
        ++options;
      }
    }
  }
  CHECK(options > 200);
}

TEST_CASE("render: what is not given stays open") {
  const CommandRequest c = render_request({});
  CHECK_FALSE(c.spp);
  CHECK_FALSE(c.samples);
  CHECK_FALSE(c.scene.size);
  CHECK(c.scene.render.given.empty());
  CHECK_FALSE(c.resume);
  CHECK_FALSE(c.checkpoint);
  CHECK(c.threads == 0);
  CHECK(c.progress == ProgressStyle::automatic);
  CHECK(render_request({"-q"}).progress == ProgressStyle::none);
}

TEST_CASE("overrides keep their order; the last of a repeated option wins; an output takes one name") {
  const CommandRequest c = render_request({"--set", "/b=1", "--set", "/a=[1,2,3]", "--spp", "1", "--spp", "2"});
  REQUIRE(c.scene.overrides.size() == 2);
  CHECK(c.scene.overrides[0].pointer == "/b");
  CHECK(c.scene.overrides[1].value == "[1,2,3]");
  CHECK(c.spp == 2u);
  CHECK(std::get<CommandRequest>(read_command({"render", "-o", "a.png", "box"})).scene.what == "box");
  CHECK(std::get<CommandRequest>(read_command({"render", "-o", "a.png", "--", "-a.json"})).scene.what == "-a.json");
  CHECK(std::get<CommandRequest>(read_command({"render", "render", "--output=[a].png"})).outputs.front() == "[a].png");
}

TEST_CASE("refusals name the option, what was found and what is expected") {
  CHECK(refusal({"render", "b", "-o", "a.png", "--size", "8"}) ==
        R"(--size: found "8", expected WIDTHxHEIGHT in pixels, such as 800x450)");
  CHECK(has(refusal({"render", "b", "-o", "a.png", "--spp", "0"}), R"(--spp: found "0")"));
  CHECK(has(refusal({"render", "b", "-o", "a.png", "-t", "0"}), R"(--threads: found "0")"));
  CHECK(has(refusal({"render", "b", "-o", "a.png", "--time", "0"}), "--time"));
  CHECK(has(refusal({"render", "b", "-o", "a.png", "--spp"}), "--spp: a value is missing"));
  CHECK(has(refusal({""}), "SCENE is missing"));
  CHECK(has(refusal({"render", "b"}), "an output (-o FILE) is missing"));
  CHECK(has(refusal({"render", "-o", "a.png"}), "SCENE is missing"));
  CHECK(has(refusal({"render", "a", "b", "-o", "a.png"}), R"(unexpected argument "b")"));
  CHECK(has(refusal({"compare", "a"}), "REFERENCE is missing"));
  CHECK(has(refusal({"compare", "a", "b", "--max-rmse", "-1"}), "--max-rmse"));
  CHECK(has(refusal({"compare", "a", "b", "--heatmap", "h.jpg"}), "--heatmap"));
  CHECK(has(refusal({"convert", "a", "-o", "a.png"}), ".json"));
  CHECK(has(refusal({"merge", "-o", "a.png"}), "PART is missing"));
}

TEST_CASE("unknown options and commands get a suggestion") {
  CHECK(
      has(refusal({"render", "b", "-o", "a.png", "--sede=3"}), R"(unknown option "--sede" (did you mean "--seed"?))"));
  CHECK(has(refusal({"rendr", "box", "-o", "a.png"}), R"(unknown command "rendr" (did you mean "render"?))"));
  CHECK(has(refusal({"scene"}), R"(did you mean "scenes"?)"));
  CHECK(has(refusal({"--verson"}), R"(unknown option "--verson" (did you mean "--version"?))"));
  CHECK(has(refusal({"--hlep"}), R"(did you mean "--help"?)"));
  CHECK(has(refusal({"--stats", "a.json"}), "--stats"));
}

TEST_CASE("limits that exclude each other are named") {
  for (const Arguments& other : std::vector<Arguments>{{"--spp", "4"}, {"--time", "1"}, {"--target-error", "0.1"}}) {
    Arguments arguments = {"render", "b", "-o", "a.png", "--samples", "0:4"};
    arguments.insert(arguments.end(), other.begin(), other.end());
    CHECK(has(refusal(arguments), "--samples and " + other[0]));
  }
  CHECK(render_request({"--samples", "4:8"}).samples->first == 4);
}

TEST_CASE("adaptive sampling: off unless asked for, where pictures are rendered") {
  CHECK_FALSE(render_request({}).scene.render.values.adaptive);
  CHECK(render_request({"--adaptive"}).scene.render.values.adaptive);
  CHECK(std::get<CommandRequest>(read_command({"view", "--adaptive", "box"})).scene.render.values.adaptive);
  const auto chart = std::get<CommandRequest>(
      read_command({"chart", "box", "-o", "a.svg", "--method", "even=", "--method", "adaptive=--adaptive --seed 3"}));
  CHECK_FALSE(chart.methods.at(0).scene.render.values.adaptive);
  CHECK(chart.methods.at(1).scene.render.values.adaptive);
  CHECK(has(refusal({"verify", "--adaptive"}), "unknown option"));
}

TEST_CASE("verify: names, method, machine") {
  const auto command = std::get<CommandRequest>(read_command(
      {"verify", "plate", "--json", "milk", "--isa", "scalar", "-t", "2", "--integrator", "nee", "--seed", "7", "-q"}));
  CHECK(command.operands == std::vector<std::string>{"plate", "milk"});
  CHECK(command.json);
  CHECK_FALSE(command.thorough);
  CHECK(command.isa == "scalar");
  CHECK(command.threads == 2);
  CHECK(command.scene.render.values.integrator == Integrator::nee);
  CHECK(command.scene.render.values.seed == 7u);
  CHECK(command.progress == ProgressStyle::none);
  CHECK(std::get<CommandRequest>(read_command({"verify", "--thorough"})).thorough);
  CHECK(has(refusal({"verify", "--size", "8x8"}), "unknown option \"--size\""));
}

TEST_CASE("inspect: an instruction set is only for measuring") {
  CHECK(std::get<CommandRequest>(read_command({"inspect", "box", "--measure", "--isa", "sse4"})).isa == "sse4");
  CHECK(has(refusal({"inspect", "box", "--isa", "sse4"}), "--measure"));
}

TEST_CASE("chart: methods with flags of their own, reference, budget") {
  const auto command =
      std::get<CommandRequest>(read_command({"chart", "box", "-o", "a.svg", "--method", "plain=", "--method",
                                             "no MIS=--integrator nee --isa scalar", "--budget", "7"}));
  CHECK(command.scene.what == "box");
  CHECK(command.output == "a.svg");
  CHECK(command.budget == 7);
  REQUIRE(command.methods.size() == 2);
  CHECK(command.methods[0].curve == "plain");
  CHECK_FALSE(command.methods[0].scene.render.given.contains("integrator"));
  CHECK(command.methods[1].curve == "no MIS");
  CHECK(command.methods[1].scene.render.values.integrator == Integrator::nee);
  CHECK(command.methods[1].isa == "scalar");
  CHECK(std::get<CommandRequest>(read_command({"chart", "all", "-o", "charts"})).output == "charts");
  CHECK(has(refusal({"chart", "box"}), "-o FILE.svg"));
  CHECK(has(refusal({"chart", "box", "-o", "a.png"}), ".svg"));
  CHECK(has(refusal({"chart", "box", "-o", "a.svg", "--method", "nee"}), "NAME=FLAGS"));
  CHECK(has(refusal({"chart", "box", "-o", "a.svg", "--method", "a=--integrator neee"}), "did you mean"));
  CHECK(has(refusal({"chart", "box", "-o", "a.svg", "--budget", "0"}), "seconds > 0"));
}

TEST_CASE("help names every command and option, with units and defaults") {
  const std::string overview = printed({"--help"});
  for (const char* name : {"view", "render", "compare", "chart", "verify", "merge", "inspect", "scenes", "convert"})
    CHECK(has(overview, std::string("\n  ") + name + " "));
  CHECK(printed({"-h"}) == overview);
  for (const char* argument : {"--version", "-V", "version"}) CHECK(has(printed({argument}), "tyndall "));
  const std::string render = printed({"render", "--help"});
  for (const char* option : {"--output FILE",
                             "--size WxH",
                             "--spp N",
                             "--samples A:B",
                             "--time SECONDS",
                             "--target-error E",
                             "--max-depth N",
                             "--integrator NAME",
                             "--sampler NAME",
                             "--fresnel NAME",
                             "--caustics NAME",
                             "--exposure EV",
                             "--tone-map NAME",
                             "--set POINTER=VALUE",
                             "--region X0,Y0,X1,Y1",
                             "--seed N",
                             "--threads N",
                             "--isa NAME",
                             "--stats FILE.json",
                             "--resume",
                             "--quiet",
                             "--progress NAME",
                             "--checkpoint SECONDS",
                             "--fresh"})
    CHECK_MESSAGE(has(render, option), option);
  CHECK(has(render, "else 64"));
  CHECK(has(render, "else 1000"));
  CHECK(has(printed({"compare", "--help"}), "depends on the unit of radiance"));
  for (const char* command : {"view", "merge", "inspect", "scenes", "convert"})
    CHECK(has(printed({command, "--help"}), std::string("Usage: tyndall ") + command));
}

TEST_CASE("help fits into 100 columns") {
  for (const char* command : {"view", "render", "compare", "merge", "inspect", "scenes", "convert"}) {
    const std::string text = printed({command, "--help"});
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = text.find('\n', at);
      CHECK_MESSAGE(end - at <= 100, text.substr(at, end - at));
      at = end + 1;
    }
  }
}

}  // namespace tyndall::test::options_test
