#pragma once
#include "core/base/vec.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <utility>
#include <vector>

/// What compiled scenes are made of, for whoever fills it and for kernels.
namespace tyndall {

/// A list of values that kernels read where it lies. It grows like a std::vector. Copies share their values until one
/// of them is changed, so that a copy of a scene with another camera costs microseconds.
///
/// Kernels may call what is TYNDALL_INLINE, and no function of a standard container: the linker keeps one copy of such
/// a function for all files, and a copy with wide instructions would crash older CPUs.
template <class T>
class Column {
 public:
  Column() = default;
  Column(const std::vector<T>& values) {
    resize(values.size());
    std::copy(values.begin(), values.end(), first_);
  }
  Column(const Column& other) : first_(other.first_), count_(other.count_) {
    if (first_) ++head()->users;
  }
  Column& operator=(Column other) {
    std::swap(first_, other.first_);
    std::swap(count_, other.count_);
    return *this;
  }
  ~Column() {
    if (!first_ || --head()->users > 0) return;
    std::destroy_n(first_, head()->room);
    std::allocator<Head>().deallocate(head(), heads(head()->room));
  }

  /// The first value: column[i], and tables for gather() and lookup().
  TYNDALL_INLINE operator const T*() const { return first_; }
  TYNDALL_INLINE int count() const { return count_; }
  TYNDALL_INLINE bool empty() const { return count_ == 0; }
  std::size_t size() const { return static_cast<std::size_t>(count_); }
  const T* begin() const { return first_; }
  const T* end() const { return first_ + count_; }
  bool operator==(const Column& other) const { return std::equal(begin(), end(), other.begin(), other.end()); }

  // The functions below give the column values of its own before they are changed.
  operator T*() { return own(size()); }
  T* begin() { return own(size()); }
  T* end() { return own(size()) + count_; }
  T& back() { return end()[-1]; }
  void reserve(std::size_t room) { own(room); }
  void push_back(const T& value) { resize(size() + 1, value); }
  void resize(std::size_t size, T value = {}) {
    own(size);
    if (size > this->size()) std::fill(first_ + count_, first_ + size, value);
    count_ = static_cast<int>(size);
  }
  void assign(std::size_t size, const T& value) {
    count_ = 0;
    resize(size, value);
  }

 private:
  /// What lies before the first value.
  struct alignas(std::max(alignof(std::max_align_t), alignof(T))) Head {
    std::atomic<int> users;  ///< columns that share the values
    std::size_t room;        ///< values that were constructed, those beyond count_ as well
  };
  /// As much memory as a head and the values take, in heads, so that it is aligned as these are.
  static constexpr std::size_t heads(std::size_t room) { return 2 + room * sizeof(T) / sizeof(Head); }
  Head* head() const { return reinterpret_cast<Head*>(first_) - 1; }

  /// Memory that no other column shares, with room for at least so many values.
  T* own(std::size_t room) {
    const std::size_t had = first_ ? head()->room : 0;
    if (room <= had && (!first_ || head()->users == 1)) return first_;
    room = room > had ? std::max(room, 2 * size()) : had;
    if (room > std::numeric_limits<int>::max()) throw std::bad_alloc();
    Column larger;
    larger.first_ = reinterpret_cast<T*>(new (std::allocator<Head>().allocate(heads(room))) Head{1, room} + 1);
    std::uninitialized_value_construct_n(larger.first_, room);
    std::copy_n(first_, size(), larger.first_);
    std::swap(first_, larger.first_);
    return first_;
  }

  T* first_ = nullptr;
  int count_ = 0;
};

template <class F, class T>
TYNDALL_INLINE LanesFrom<F, T> gather(const Column<T>& table, IntOf<F> index) {
  return gather<F>(static_cast<const T*>(table), index);
}
template <class F, class T>
TYNDALL_INLINE LanesFrom<F, T> lookup(const Column<T>& table, int count, IntOf<F> index) {
  return lookup<F>(static_cast<const T*>(table), count, index);
}

/// A column of vectors, component by component, so that lookup() serves them as it serves numbers.
struct VectorColumn {
  Column<float> x, y, z;
  TYNDALL_INLINE Vec3f operator[](auto k) const { return {x[k], y[k], z[k]}; }
  std::size_t size() const { return x.size(); }
  void set(std::size_t k, Vec3f v) { x[k] = v.x, y[k] = v.y, z[k] = v.z; }
  void push_back(Vec3f v) { x.push_back(v.x), y.push_back(v.y), z.push_back(v.z); }
  bool operator==(const VectorColumn&) const = default;
};
template <class F>
TYNDALL_INLINE Vec3<F> lookup(const VectorColumn& table, int count, IntOf<F> index) {
  return {lookup<F>(table.x, count, index), lookup<F>(table.y, count, index), lookup<F>(table.z, count, index)};
}

/// A record of a column in each lane, to be read by members: record(&Record::member), record(&Record::array, index).
template <class F, class Record>
struct RecordIn {
  const Record* first;
  IntOf<F> at;  ///< of the record, in numbers of four bytes

  template <class T>
  TYNDALL_INLINE auto operator()(T Record::*member) const {
    return value(first->*member);
  }
  template <class T, std::size_t n>
  TYNDALL_INLINE auto operator()(T (Record::*member)[n], int k) const {
    return value((first->*member)[k]);
  }
  TYNDALL_INLINE F value(const float& of_first) const { return gather<F>(&of_first, at); }
  TYNDALL_INLINE IntOf<F> value(const std::int32_t& of_first) const { return gather<F>(&of_first, at); }
  TYNDALL_INLINE Vec3<F> value(const Vec3f& of_first) const {
    return {value(of_first.x), value(of_first.y), value(of_first.z)};
  }
};
template <class F, class Record>
TYNDALL_INLINE RecordIn<F, Record> record_in(const Column<Record>& records, IntOf<F> index) {
  return {records, index * IntOf<F>(static_cast<std::int32_t>(sizeof(Record) / 4))};
}

}  // namespace tyndall
