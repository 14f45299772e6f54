#pragma once
#include <cstdlib>
#include <span>
#include <utility>

#include "common/published/cull/walk_table.h"

namespace swath {

// Owns what grow() allocates for a list, a queue or a walk's leaves. `List` has a pointer `at`.
template <class List>
class OwnedList {
  public:
    OwnedList() = default;
    OwnedList(OwnedList&& other) noexcept : list_(std::exchange(other.list_, List{})) {}
    OwnedList& operator=(OwnedList&&) = delete;
    ~OwnedList() { std::free(list_.at); }

    List& operator*() { return list_; }
    List* operator->() { return &list_; }
    const List* operator->() const { return &list_; }

  private:
    List list_{};
};

template <class T>
std::span<const T> contents(const WalkList<T>& list) {
    return {list.at, list.size};
}

}  // namespace swath
