#include "app/cli/requests.h"
#include "app/manual/page.h"

#include <doctest/doctest.h>

#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace tyndall::test::options_test {

namespace {

using Files = std::vector<std::filesystem::path>;

/// The words of a command line; _ stands for a space in a word.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream stream(line);
  for (std::string word; stream >> word;) {
    std::replace(word.begin(), word.end(), '_', ' ');
    words.push_back(word);
  }
  return words;
}

CommandRequest request(const std::string& line) { return read_command(words_of(line)); }

std::string refusal(const std::string& line) {
  try {
    read_command(words_of(line));
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

std::string printed(const std::string& line) { return request(line).text; }

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("without a command: the window, which takes limits at which the picture pauses") {
  CHECK(request("").scene.what == "showroom");
  CHECK(request("view").scene.what == "showroom");
  CHECK(request("cornell-box").scene.what == "cornell-box");
  CHECK(request("-").scene.what == "-");
  CHECK(request("a.json --reference b.exr").reference == "b.exr");
  const CommandRequest view = request("--seed 7 a.json -t 2 --spp 16 --time 2.5 --target-error 0.02 --adaptive");
  CHECK(view.scene.what == "a.json");
  CHECK(view.scene.render.values.seed == 7u);
  CHECK(view.scene.render.values.spp == 16);
  CHECK(view.scene.render.values.adaptive);
  CHECK(view.scene.render.given.contains("spp"));
  CHECK(view.threads == 2);
  CHECK(view.time_limit == 2.5);
  CHECK(view.target_error == 0.02);
}

TEST_CASE("programs: more source files and folders of headers, and leave to compile what was named") {
  const CommandRequest render = request("render main.cc -I a b.cpp c.cxx -Id --include e -o x.png");
  const ProgramParts& parts = render.scene.program;
  CHECK(render.scene.what == "main.cc");
  CHECK(parts.sources.files == Files{"b.cpp", "c.cxx"});
  CHECK(parts.sources.include_folders == Files{"a", "d", "e"});
  CHECK(parts.allowed);
  CHECK_FALSE(parts.trusted);
  CHECK(request("main.cc").scene.program.allowed);
  CHECK_FALSE(request("").scene.program.allowed);
  CHECK(request("inspect main.cc --trust").scene.program.trusted);
  CHECK_FALSE(request("verify").scene.program.allowed);
  CHECK(refusal("inspect main.cc a.json") == "unexpected argument \"a.json\" (see tyndall inspect --help)");
  CHECK(refusal("inspect a.json main.cc") == "unexpected argument \"main.cc\" (see tyndall inspect --help)");
}

TEST_CASE("render: every option arrives, and what is not given stays open") {
  const CommandRequest c = request(
      "render box.json -o a.png -o b.exr --size 64x32 --spp 16 --time 2.5 --max-depth 7 --sampler random --integrator "
      "path --fresnel schlick --exposure -1.5 --tone-map aces --seed 4294967295 --region 1,2,3,4 --isa scalar --stats "
      "s.json --resume -t 3 --target-error 0.01 --progress plain --checkpoint 90 --sharing off --adaptive");
  CHECK(c.scene.what == "box.json");
  CHECK(c.outputs == Files{"a.png", "b.exr"});
  CHECK(c.scene.size->width == 64);
  CHECK(c.scene.size->height == 32);
  CHECK(c.spp == 16u);
  CHECK(c.time_limit == 2.5);
  CHECK(c.target_error == 0.01);
  const RenderSettings& settings = c.scene.render.values;
  CHECK(settings.max_depth == 7);
  CHECK(settings.sampler == SamplerKind::random);
  CHECK(settings.integrator == Integrator::path);
  CHECK(settings.fresnel == FresnelKind::schlick);
  CHECK(settings.seed == 4294967295u);
  CHECK_FALSE(settings.sharing);
  CHECK(settings.adaptive);
  CHECK(c.scene.render.given.size() == 7);
  CHECK(c.scene.display.values.exposure == -1.5);
  CHECK(c.scene.display.values.tone_map == ToneMap::aces);
  CHECK(c.region == Region{1, 2, 3, 4});
  CHECK(c.isa == "scalar");
  CHECK(c.stats == "s.json");
  CHECK(c.resume);
  CHECK_FALSE(c.fresh);
  CHECK(c.checkpoint == 90.0);
  CHECK(c.threads == 3);
  CHECK(c.progress == ProgressStyle::plain);
  CHECK(request("render box -o a.png --samples 4:8").sample_range->first == 4);
  CHECK(request("render box -o a.png --fresh").fresh);
  CHECK(request("render box -o a.png -q").progress == ProgressStyle::none);
  const CommandRequest open = request("render box -o a.png");
  CHECK_FALSE((open.spp || open.sample_range || open.scene.size || open.checkpoint || open.resume));
  CHECK(open.scene.render.given.empty());
  CHECK(open.threads == 0);
  CHECK(open.progress == ProgressStyle::automatic);
}

TEST_CASE("every option of every command takes a value of its kind, by each of its names") {
  std::map<std::string, std::string> values{{"", ""}};
  const std::string some =
      "N 7 X 0.5 Z 4 E 0.1 EV 1 WxH 4x3 A:B 0:4 X0,Y0,X1,Y1 0,0,1,1 DIR a SECONDS 2 FILE - NAME %d.json SHEET.png "
      "a.png "
      "X,Y,SAMPLE 1,2,3 NAME=FLAGS a=--seed_3 HOST[:PORT] localhost POINTER=VALUE /a=1 POINTER=VALUES /a=1:2:3";
  std::istringstream units(some);
  for (std::string unit; units >> unit;) units >> values[unit];
  int options = 0;
  for (const CommandRow& command : command_rows())
    for (const OptionRow& option : command.options) {
      if (option.names == "-h,--help" || option.heading.empty()) continue;
      std::string value = option.taker.choices.empty() ? "" : option.taker.choices.front();
      if (option.names == "--each") value = "%v.png";
      if (option.unit.starts_with("FILE.")) value = "a" + option.unit.substr(4);
      if (value.empty()) value = values.at(option.unit);
      std::istringstream names(option.names);
      for (std::string name; std::getline(names, name, ','); ++options) {
        const std::string text = refusal(command.name() + " " + name + " " + value);
        CHECK_MESSAGE((text.empty() || has(text, " is missing (see ") || has(text, " need --baseline")), text);
      }
    }
  CHECK(options > 200);
}

TEST_CASE("overrides keep their order; the last of a repeated option wins; an output takes one name") {
  const CommandRequest c = request("render box -o a.png --set /b=1 --set /a=[1,2,3] --spp 1 --spp 2");
  REQUIRE(c.scene.overrides.size() == 2);
  CHECK(c.scene.overrides[0].pointer == "/b");
  CHECK(c.scene.overrides[1].value == "[1,2,3]");
  CHECK(c.spp == 2u);
  CHECK(request("render -o a.png box").scene.what == "box");
  CHECK(request("render -o a.png -- -a.json").scene.what == "-a.json");
  CHECK(request("render render --output=[a].png").outputs.front() == "[a].png");
}

TEST_CASE("refusals name the option, what was found and what is expected; near misses get a suggestion") {
  const std::string box = "render b -o a.png ", chart = "chart box -o a.svg ";
  const std::pair<std::string, std::string> refused[] = {
      {box + "--size 8", R"(--size: found "8", expected WIDTHxHEIGHT in pixels, such as 800x450)"},
      {box + "--spp 0", R"(--spp: found "0")"},
      {box + "-t 0", R"(--threads: found "0")"},
      {box + "--time 0", "--time: found \"0\", expected a number of seconds > 0"},
      {box + "--spp", "--spp: a value is missing (see tyndall render --help)"},
      {box + "--max-depth -1", "--max-depth: found \"-1\", expected a whole number in [0, "},
      {box + "--exposure 1e9", "--exposure: found \"1e9\", expected a number in [-"},
      {box + "--sampler sobl", R"(found "sobl", expected one of "random", "sobol" (did you mean "sobol"?))"},
      {box + "--sharing yes", R"(--sharing: found "yes", expected one of "off", "on")"},
      {box + "--sede=3", R"(unknown option "--sede" (did you mean "--seed"?))"},
      {box + "--samples 0:4 --spp 4", "--samples and --spp"},
      {box + "--samples 0:4 --time 1", "--samples and --time"},
      {box + "--samples 0:4 --target-error 0.1", "--samples and --target-error"},
      {"render b", "an output (-o FILE) is missing"},
      {"render -o a.png", "SCENE is missing"},
      {"render a b -o a.png", R"(unexpected argument "b")"},
      {"compare a", "REFERENCE is missing"},
      {"compare a b --max-rmse -1", "--max-rmse"},
      {"compare a b --heatmap h.jpg", "--heatmap"},
      {"convert a -o a.png", ".json"},
      {"merge -o a.png", "PART is missing"},
      {"verify --size 8x8", "unknown option \"--size\""},
      {"verify --adaptive", "unknown option"},
      {"inspect box --isa sse4", "--measure"},
      {"chart box", "-o FILE.svg"},
      {"chart box -o a.png", ".svg"},
      {chart + "--method nee", "NAME=FLAGS"},
      {chart + "--method a=--integrator_neee", "did you mean"},
      {chart + "--budget 0", "seconds > 0"},
      {"rendr box -o a.png", R"(unknown command "rendr" (did you mean "render"?))"},
      {"scene", R"(did you mean "scenes"?)"},
      {"--verson", R"(unknown option "--verson" (did you mean "--version"?))"},
      {"--hlep", R"(did you mean "--help"?)"},
      {"--stats a.json", "--stats"}};
  for (const auto& [line, words] : refused) CHECK_MESSAGE(has(refusal(line), words), line, ": ", refusal(line));
  CHECK_THROWS_WITH_AS(read_command({""}), "SCENE is missing (see tyndall view --help)", UsageError);
}

TEST_CASE("verify, inspect and chart: names, method, machine") {
  const CommandRequest verify = request("verify plate --json milk --isa scalar -t 2 --integrator nee --seed 7 -q");
  CHECK(verify.operands == std::vector<std::string>{"plate", "milk"});
  CHECK(verify.json);
  CHECK_FALSE(verify.thorough);
  CHECK(verify.scene.render.values.integrator == Integrator::nee);
  CHECK(request("verify --thorough").thorough);
  CHECK(request("inspect box --measure --isa sse4").isa == "sse4");
  const CommandRequest chart =
      request("chart box -o a.svg --method plain= --method no_MIS=--integrator_nee_--isa_scalar --budget 7");
  CHECK(chart.scene.what == "box");
  CHECK(chart.output == "a.svg");
  CHECK(chart.budget == 7);
  REQUIRE(chart.methods.size() == 2);
  CHECK(chart.methods[0].curve == "plain");
  CHECK(chart.methods[0].scene.render.given.empty());
  CHECK(chart.methods[1].curve == "no MIS");
  CHECK(chart.methods[1].scene.render.values.integrator == Integrator::nee);
  CHECK(chart.methods[1].isa == "scalar");
  CHECK(request("chart all -o charts").output == "charts");
}

TEST_CASE("help: every command and option with unit and default, within 104 columns; examples are read") {
  const std::string overview = printed("--help");
  CHECK(printed("-h") == overview);
  for (const char* argument : {"--version", "-V", "version"}) CHECK(has(printed(argument), "tyndall "));
  for (const CommandRow& command : command_rows()) {
    CHECK(has(overview, "\n  " + command.name() + " "));
    const std::string help = printed(command.name() + " --help");
    CHECK(has(help, "Usage: tyndall " + command.name()));
    for (const OptionRow& option : command.options)
      CHECK_MESSAGE(
          option.heading.empty() != has(help, "\n  " + option.names + (option.unit.empty() ? " " : " " + option.unit)),
          option.names);
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) {
      CHECK_MESSAGE(line.size() <= 104, line);
      const bool is_example = line.starts_with("  tyndall ") && !has(line, "'") && !has(line, "|");
      if (is_example) CHECK_MESSAGE(refusal(line.substr(10, line.find(" #") - 10)).empty(), line);
    }
  }
  const std::string render = printed("render --help");
  for (const char* text :
       {"[from the scene, else 1000]", "--sharing on|off", "random (independent numbers)", "else 64"})
    CHECK_MESSAGE(has(render, text), text);
  CHECK(has(printed("compare --help"), "depends on the unit of radiance"));
}

}  // namespace tyndall::test::options_test
