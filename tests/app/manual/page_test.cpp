#include "app/manual/page.h"
#include "core/base/target.h"

#include <doctest/doctest.h>

namespace tyndall::test::page_test {

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const OptionRow output{"-o,--output", "FILE", {}, "the image; it's required", "", "Output"};
const OptionRow method{"--method", "NAME", {{}, {"fast", "slow"}}, "how [from the scene]", "", "Method"};
const OptionRow quiet{"-q,--quiet", "", {}, ".dots and \\ backslashes", "", "Output"};
const OptionRow bits{"--bits", "N", {}, "bits[8]", "", "Output"};
const std::vector<CommandRow> rows{{"paint SCENE -o FILE",
                                    "paint a scene",
                                    "Paints.\n\nSlowly.",
                                    "tyndall paint a.json",
                                    {},
                                    nullptr,
                                    {{"SCENE", " ", {}, "a scene"}},
                                    {output, method, quiet, bits}},
                                   {"list", "list: all of them", "Lists.", "", {}, nullptr}};

}  // namespace

TEST_CASE("manual: every option with its value, nothing that the formatter would take for a request") {
  const std::string text = man_page(rows);
  CHECK(has(text, ".SH PAINT\n.B tyndall paint SCENE \\-o FILE\n"));
  CHECK(has(text, "Paints.\n.PP\nSlowly.\n"));
  CHECK(has(text, ".SS Output\n.TP\n\\fB\\-o\\fR, \\fB\\-\\-output\\fR \\fIFILE\\fR\nthe image; it's required\n"));
  CHECK(has(text, "\n\\&.dots and \\e backslashes\n.TP\n\\fB\\-\\-bits"));  // of the same group
  CHECK(has(text, ".nf\ntyndall paint a.json\n.fi\n"));
}

TEST_CASE("completion: names, choices and files") {
  const std::string bash = bash_completion(rows);
  CHECK(has(bash, "'paint -o' | 'paint --output') _tyndall_files \"$word\"; return ;;"));
  CHECK(has(bash, "'paint --method') words='fast slow' ;;"));
  CHECK(has(bash, "paint) words='-o --output --method -q --quiet --bits' ;;"));
  CHECK(has(bash, "'paint --bits') return ;;"));
  CHECK_FALSE(has(bash, "'paint -q'"));
  const std::string fish = fish_completion(rows);
  CHECK(has(fish, "-s o -l output -r -F -d 'the image'"));
  CHECK(has(fish, "-l method -x -a 'fast slow' -d 'how'"));
  CHECK(has(fish, "-l bits -x -d 'bits[8]'"));
  CHECK(has(fish, "-a list -d 'list'"));
  const std::string zsh = zsh_completion(rows);
  CHECK(has(zsh, "'*'{-o,--output}'[the image]:FILE:_files'"));
  CHECK(has(zsh, "'*'--method'[how]:NAME:(fast slow)'"));
  CHECK(has(zsh, "'*'{-q,--quiet}'[.dots and \\ backslashes]'"));
  CHECK(has(zsh, "'*'--bits'[bits(8)]:N:'"));
}

TEST_CASE("version: the compiler, all targets of this build, the libraries") {
  const std::string text = version_text();
  CHECK(text.rfind("tyndall " TYNDALL_VERSION "\ncompiler   ", 0) == 0);
  for (const Target target : available_targets()) CHECK(has(text, std::string(" ") + name_of(target)));
  CHECK(has(text, "\nlibraries  CLI11 "));
}

}  // namespace tyndall::test::page_test
