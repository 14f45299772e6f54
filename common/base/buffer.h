#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <utility>

namespace swath {

// A block of bytes that grows without being zeroed and keeps its capacity when it is reused. It moves and is
// not copied: pixel bodies are megabytes. A buffer that was moved from is empty and can be used again. One
// thread at a time.
class Buffer {
  public:
    Buffer() = default;
    explicit Buffer(std::size_t size) { resize(size); }
    Buffer(Buffer&& from) noexcept
        : data_(std::move(from.data_)),
          size_(std::exchange(from.size_, 0)),
          capacity_(std::exchange(from.capacity_, 0)) {}
    Buffer& operator=(Buffer&& from) noexcept {
        Buffer taken(std::move(from));
        std::swap(data_, taken.data_);
        std::swap(size_, taken.size_);
        std::swap(capacity_, taken.capacity_);
        return *this;
    }

    std::uint8_t* data() { return data_.get(); }
    const std::uint8_t* data() const { return data_.get(); }
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    std::span<const std::uint8_t> bytes() const { return {data_.get(), size_}; }

    // Bytes up to the smaller size survive, new ones are uninitialised.
    void resize(std::size_t size) {
        if (size > capacity_) grow(size);
        size_ = size;
    }
    // `from` must lie outside of this buffer, because growing moves it.
    void append(const void* from, std::size_t count) {
        if (count == 0) return;
        const std::size_t at = size_;
        resize(at + count);
        std::memcpy(data_.get() + at, from, count);
    }

  private:
    void grow(std::size_t size) {
        const std::size_t capacity = size > 2 * capacity_ ? size : 2 * capacity_;
        auto bigger = std::make_unique_for_overwrite<std::uint8_t[]>(capacity);
        if (size_ > 0) std::memcpy(bigger.get(), data_.get(), size_);
        data_ = std::move(bigger);
        capacity_ = capacity;
    }

    std::unique_ptr<std::uint8_t[]> data_;
    std::size_t size_ = 0;
    std::size_t capacity_ = 0;
};

}  // namespace swath
