#pragma once
#include "core/base/vec.h"

#include <algorithm>
#include <cstddef>
#include <memory>
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
  Column(const Column&) = default;  // moved by copying, so that what is left behind stays valid
  Column& operator=(const Column&) = default;

  /// The first value: column[i], and tables for gather() and lookup().
  TYNDALL_INLINE operator const T*() const { return first_; }
  TYNDALL_INLINE int count() const { return static_cast<int>(size_); }
  TYNDALL_INLINE bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  const T* begin() const { return first_; }
  const T* end() const { return first_ + size_; }
  bool operator==(const Column& other) const { return std::equal(begin(), end(), other.begin(), other.end()); }

  // The functions below give the column values of its own before they are changed.
  operator T*() { return own(size_); }
  T* begin() { return own(size_); }
  T* end() { return own(size_) + size_; }
  T& back() { return end()[-1]; }
  void reserve(std::size_t room) { own(room); }
  void push_back(const T& value) { resize(size_ + 1, value); }
  void resize(std::size_t size, T value = {}) {
    own(size);
    if (size > size_) std::fill(first_ + size_, first_ + size, value);
    size_ = size;
  }
  void assign(std::size_t size, const T& value) {
    size_ = 0;
    resize(size, value);
  }

 private:
  /// Memory that no other column shares, with room for at least so many values.
  T* own(std::size_t room) {
    if (room > room_ || memory_.use_count() > 1) {
      if (room > room_) room_ = std::max(room, 2 * size_);
      const std::shared_ptr<T[]> memory(new T[room_]());
      std::copy_n(first_, size_, memory.get());
      memory_ = memory, first_ = memory.get();
    }
    return first_;
  }

  T* first_ = nullptr;
  std::size_t size_ = 0, room_ = 0;
  std::shared_ptr<T[]> memory_;
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
