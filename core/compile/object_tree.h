#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

namespace tyndall {

/// Numbers all objects of a scene, from 0, and gives the path of each: the indices into Scene::objects and the lists of
/// its groups. Stores two numbers an object, because a scene may have millions.
class ObjectTree {
 public:
  /// Makes room for as many objects.
  void reserve(std::size_t objects) { steps_.reserve(objects); }

  /// Adds the object at `index` in the list of a group and returns its number. group: number of the group; -1:
  /// Scene::objects.
  std::int32_t add(std::int32_t group, std::size_t index) {
    steps_.push_back({group, static_cast<std::int32_t>(index)});
    return static_cast<std::int32_t>(steps_.size()) - 1;
  }

  /// The path of an object, from Scene::objects to itself.
  std::vector<int> path(std::int32_t object) const {
    std::vector<int> indices;
    for (; object >= 0; object = step(object).group) indices.push_back(step(object).index);
    std::reverse(indices.begin(), indices.end());
    return indices;
  }

 private:
  struct Step {
    std::int32_t group, index;
  };
  const Step& step(std::int32_t object) const { return steps_[static_cast<std::size_t>(object)]; }

  std::vector<Step> steps_;
};

}  // namespace tyndall
