#include "app/files/arriving_picture.h"
#include "core/base/error.h"
#include "core/image/tonemap.h"
#include "tests/support/news.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <memory>
#include <string>

namespace tyndall::test::arriving_picture_test {

namespace {

/// A pipe into which the test writes as another program would.
struct Pipe {
  OpenFile reader, writer;

  explicit Pipe(const std::string& begin) {
    int ends[2];
    REQUIRE(::pipe(ends) == 0);
    reader = OpenFile(ends[0]), writer = OpenFile(ends[1]);
    write(begin);
  }
  void write(const std::string& text) const { REQUIRE(writer.write(text.data(), text.size()) == 0); }
  std::string begin() const { return beginning_of(reader.descriptor()).bytes; }
};

/// A picture that comes by a pipe, and the news of it.
struct Arriving {
  Pipe pipe;
  test::News news;
  ArrivingPicture picture;

  explicit Arriving(const std::string& begin, PpmCurve curve = PpmCurve::srgb)
      : pipe(begin), picture(pipe.reader.descriptor(), pipe.begin(), "pipe", curve) {
    picture.start([this] { news.tell(); });
  }
  bool has_rows(int rows) {
    return news.wait_until([&] { return picture.arrival().rows == rows; });
  }
  /// What is said at the end.
  std::string said() {
    CHECK(news.wait_until([&] { return picture.arrival().ended; }));
    return picture.arrival().said;
  }
  Vec3f at(double x, double y) const { return picture.source()->sample(x, y, 0); }
};

}  // namespace

TEST_CASE("arriving picture: rows are there while the program still writes") {
  Arriving arriving("P3 2 3 255\n");
  CHECK(arriving.picture.width() == 2);
  CHECK(arriving.picture.height() == 3);
  CHECK(arriving.picture.arrival() == Arrival{});
  arriving.pipe.write("255 0 51  0 0 0\n");
  REQUIRE(arriving.has_rows(1));
  CHECK(arriving.at(0.3, 0.9).x == 1);
  CHECK(arriving.at(0.3, 0.9).z == srgb_decode(0.2f));
  CHECK(arriving.at(0.3, 1.0).x == 0);  // has not come
  arriving.pipe.write("255 255 255 255 255 255 1 2 3 255 255");
  REQUIRE(arriving.has_rows(2));
  CHECK_FALSE(arriving.picture.arrival().ended);
  CHECK(arriving.at(1.5, 2.5).x == 0);
  arriving.pipe.write(" 255");
  arriving.pipe.writer.close();
  CHECK(arriving.said() == "");
  CHECK(arriving.picture.arrival().rows == 3);
  CHECK(arriving.at(1.5, 2.5).x == 1);
}

TEST_CASE("arriving picture: what is there stays when the program ends early, and it is said where") {
  Arriving arriving(std::string("P6 1 4 255\n\xff\xff\xff\xff\xff\xff\xff", 18));
  arriving.pipe.writer.close();
  CHECK(arriving.said() == "ended at row 2 of 4");
  CHECK(arriving.at(0.5, 1.5).x == 1);
  CHECK(arriving.at(0.5, 2.5).x == 0);  // one of its three numbers came
}

TEST_CASE("arriving picture: damage and numbers outside of the range are told, with the rows before them") {
  Arriving damaged("P3 1 3 255 1 2 3 300 -1 6 nan 7 8 ");
  CHECK(damaged.said() ==
        "pipe: cannot read: damaged: found \"nan\", expected a colour, a whole number; ended at row 2 of 3; 2 of 6 "
        "numbers are outside of 0 to 255 and are read as the nearest that is within; the first one, 300, is at x 0, y "
        "1");
  CHECK(damaged.at(0.5, 1.5).x == 1);
  damaged.pipe.write(std::string(300'000, '7'));  // more than a pipe holds: the program need not wait
  Arriving second("P3 1 1 255 1 2 3\nP3 1 1 255 4 5 6\n");
  CHECK(second.said() == "pipe: what follows the last pixel is not shown");
  CHECK(second.at(0.5, 0.5).x == srgb_decode(1 / 255.0f));
}

TEST_CASE("arriving picture: as the books' programs write, by the square") {
  Arriving arriving("P3 1 1 255 51 0 255 ", PpmCurve::gamma2);
  CHECK(arriving.said() == "");
  CHECK(arriving.at(0, 0).x == doctest::Approx(0.04));
}

TEST_CASE("arriving picture: what has no size is refused in one line") {
  for (const auto& [text, refusal] :
       {std::pair{"P3\n400 ", "pipe: ended where the height of a picture is expected"},
        std::pair{"P", "pipe: ended where P3 or P6 (colours), or P2 or P5 (greys) of a picture is expected"},
        std::pair{"P3 400 x 255", "pipe: cannot read: damaged: found \"x\", expected the height, a whole number"}}) {
    Pipe pipe(text);
    pipe.writer.close();
    const int file = pipe.reader.descriptor();
    CHECK_THROWS_WITH_AS(ArrivingPicture(file, pipe.begin(), "pipe", PpmCurve::srgb), refusal, UsageError);
    CHECK(pipe.begin().empty());
  }
}

TEST_CASE("arriving picture: text before it is told at once, while the program goes on") {
  const auto found = [](const std::string& text) {
    const Pipe pipe(text);  // its writer stays open
    const Beginning begin = beginning_of(pipe.reader.descriptor());
    if (begin.is_picture || begin.is_scene) return std::string(begin.is_picture ? "a picture" : "a scene");
    return first_line_of(pipe.reader.descriptor(), begin.bytes);
  };
  CHECK(found("P3\n") == "a picture");
  CHECK(found("rendering...\nP3\n2 1\n255\n") == "\"rendering...\"");
  CHECK(found("Progress 3 %") == "\"Progress 3 %\"");
  CHECK(found("\n10 rows left\r9 rows left\r") == "\"10 rows left\"");
  CHECK(found("\nP3\n") == "\"P3\"");
  CHECK(found("/home/me: rendering\n") == "\"/home/me: rendering\"");
  CHECK(found("\xef\xbb\xbfP3\n") == "a byte order mark");
  CHECK(found(std::string("\xff\xfeP\0003\0\n\0", 8)) == "text in UTF-16");
  CHECK(found("\x89PNG\r\n\x1a\n") == "a picture of another kind");
  for (const char* scene : {"{ }", "\n // a scene\n{ }", "/* a scene */ { }", "\xef\xbb\xbf{ }"})
    CHECK(found(scene) == "a scene");
}

}  // namespace tyndall::test::arriving_picture_test
