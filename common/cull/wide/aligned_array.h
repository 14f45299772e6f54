#pragma once
#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>

namespace swath {

// An array of numbers that begins at a cache line and is not initialised, so that a large one costs no memory
// where nothing was written. It moves and is not copied.
template <class T>
class AlignedArray {
  public:
    static_assert(std::is_trivial_v<T>);
    AlignedArray() = default;
    explicit AlignedArray(std::size_t size)
        : data_(static_cast<T*>(::operator new(size * sizeof(T), kLine))), size_(size) {}

    T* data() { return data_.get(); }
    const T* data() const { return data_.get(); }
    std::size_t size() const { return size_; }

  private:
    static constexpr std::align_val_t kLine{64};
    struct Release {
        void operator()(T* data) const { ::operator delete(data, kLine); }
    };
    std::unique_ptr<T[], Release> data_;
    std::size_t size_ = 0;
};

}  // namespace swath
