#pragma once
#include <cstddef>
#include <memory>

namespace swath {

// Memory that frames use again. It grows, is never zeroed, and loses its contents when it grows.
template <class T>
class Scratch {
  public:
    // Room for at least `size`, uninitialised.
    T* room(std::size_t size) {
        if (size > capacity_) {
            const std::size_t capacity = size > 2 * capacity_ ? size : 2 * capacity_;
            data_.reset();  // the old block may serve for the new one
            capacity_ = 0;  // it stays 0 if there is no memory
            data_ = std::make_unique_for_overwrite<T[]>(capacity);
            capacity_ = capacity;
        }
        return data_.get();
    }
    T* data() { return data_.get(); }

  private:
    std::unique_ptr<T[]> data_;
    std::size_t capacity_ = 0;
};

}  // namespace swath
