#include "core/compile/column.h"

#include <doctest/doctest.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace tyndall::test::column_test {

TEST_CASE("column: copies share their values until one of them is changed") {
  Column<float> first = std::vector<float>{1, 2, 3};
  Column<float> second = first;
  const Column<float>&a = first, &b = second;
  CHECK(a.begin() == b.begin());
  second[1] = 5;
  CHECK(a == std::vector<float>{1, 2, 3});
  CHECK(b == std::vector<float>{1, 5, 3});
  const float* own = b;
  second[0] = 7;
  CHECK(b.begin() == own);  // nobody shares them now
  const Column<float> third = std::move(second);
  second.push_back(8);
  first.resize(2);
  CHECK(a == std::vector<float>{1, 2});
  CHECK(b == std::vector<float>{7, 5, 3, 8});
  CHECK(third == std::vector<float>{7, 5, 3});
}

TEST_CASE("column: grows like a vector") {
  Column<std::int32_t> column;
  std::vector<std::int32_t> vector;
  CHECK(column.empty());
  for (std::int32_t i = 0; i < 1000; ++i) {
    column.push_back(i % 7 ? i : column.empty() ? 0 : column.back());
    vector.push_back(i % 7 ? i : vector.empty() ? 0 : vector.back());
    if (i % 100 == 0) column.resize(column.size() + 3, i), vector.resize(vector.size() + 3, i);
    if (i % 300 == 0) column.resize(2), vector.resize(2);
    REQUIRE(column == vector);
    REQUIRE(column.count() == static_cast<int>(vector.size()));
  }
  column.assign(3, -1);
  CHECK(column == std::vector<std::int32_t>{-1, -1, -1});
}

TEST_CASE("column: records are read by their members, vectors as one") {
  struct Record {
    float number;
    Vec3f vector;
    std::int32_t integers[2];
    bool operator==(const Record&) const = default;
  };
  const Column<Record> records = std::vector<Record>{{1, {2, 3, 4}, {5, 6}}, {7, {8, 9, 10}, {11, 12}}};
  const auto second = record_in<float>(records, 1);
  CHECK(second(&Record::number) == 7);
  CHECK(second(&Record::vector) == Vec3f{8, 9, 10});
  CHECK(second(&Record::integers, 1) == 12);
  VectorColumn vectors;
  for (const Record& r : records) vectors.push_back(r.vector);
  CHECK(lookup<float>(vectors, 2, 1) == Vec3f{8, 9, 10});
  CHECK(vectors[0] == Vec3f{2, 3, 4});
}

}  // namespace tyndall::test::column_test
