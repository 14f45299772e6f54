#pragma once
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/base/names.h"
#include "common/base/result.h"
#include "common/wire/messages.h"

namespace swath {

// Takes fields of protobuf's messages into ours (see fields.h), and checks them. What follows the first broken
// limit is read on, for nothing, but its checks are not made.
class FieldReader {
  public:
    const Status& status() const { return status_; }

    void number(auto& ours, const char*, auto value, auto) {
        ours = static_cast<std::remove_reference_t<decltype(ours)>>(value);
    }
    void at_most(auto& ours, const char* name, auto value, auto, auto limit) {
        if (std::cmp_greater(value, limit)) return refuse("{}: {}, the limit is {}", name, value, limit);
        number(ours, name, value, 0);
    }
    void below(auto& ours, const char* name, auto value, auto, auto limit) {
        if (value >= limit) return refuse("{}: {}, the limit is {}", name, value, limit);
        ours = value;
    }
    void within(auto& ours, const char* name, auto value, auto, auto least, auto most) {
        if (!(value >= least && value <= most))
            return refuse("{}: {}, the limits are {} and {}", name, value, least, most);
        ours = value;
    }
    // Of one of so many things, of which the field has its name.
    void index(auto& ours, const char* name, std::uint32_t value, auto, std::size_t limit) {
        if (value >= limit) return refuse("{}: {} {}, the limit is {}", place(name), name, value, limit);
        number(ours, name, value, 0);
    }
    template <NamedEnum E>
    void named(E& ours, const char* name, std::uint32_t value, auto) {
        const auto found = value_of<E>(value);
        if (!found) return refuse("{}: {} is none", name, value);
        ours = *found;
    }
    void time(Nanoseconds& ours, const char* name, std::int64_t ns, auto) {
        if (ns < 0 || ns > kMaxTimeNs)
            return refuse("{}: {}outside of 0 to {}", place(name), list_ ? "a time " : "", kMaxTimeNs);
        ours = Nanoseconds(ns);
    }
    void text(std::string& ours, const char* name, const std::string& value, auto) {
        if (value.size() > kMaxTextBytes)
            return refuse("{}: {} bytes, the limit is {}", place(name), value.size(), kMaxTextBytes);
        ours = value;
    }
    void reason(std::string& ours, const char* name, const std::string& value, auto set) {
        text(ours, name, value, set);
    }
    void digest(Digest& ours, const char* name, const std::string& value, auto) {
        if (value.size() != ours.size())
            return refuse("{}: {} bytes where {} are expected", name, value.size(), ours.size());
        std::copy(value.begin(), value.end(), ours.begin());
    }
    void colour(Rgb& ours, const char* name, std::uint32_t value, auto) {
        if (value > 0xffffff) return refuse("{}: {:#x}, the limit is 0xffffff", name, value);
        for (int i = 0; i < 3; ++i) ours[i] = static_cast<std::uint8_t>(value >> (16 - 8 * i));
    }

    // At least one, at most `limit`.
    template <NamedEnum E>
    void each_named(std::vector<E>& ours, const char* name, auto& list, std::size_t limit) {
        if (list.empty() || size_of(list) > limit)
            return refuse("{}: {}, the limits are 1 and {}", name, list.size(), limit);
        ours.resize(size_of(list));
        for (int i = 0; i < list.size(); ++i) named(ours[static_cast<std::size_t>(i)], name, list[i], 0);
    }
    void numbers(auto& ours, const char* name, auto& list) {
        if (size_of(list) != ours.size())
            return refuse("{}: {} where {} are expected", name, list.size(), ours.size());
        std::copy(list.begin(), list.end(), ours.begin());
    }
    void numbers(auto& ours, const char* name, auto& list, std::size_t limit) {
        if (size_of(list) > limit) return refuse("{}: {} counts, the limit is {}", name, list.size(), limit);
        ours.assign(list.begin(), list.end());
    }
    void floats(std::span<float> ours, const char* name, auto& list) {
        if (size_of(list) != ours.size())
            return refuse("{}: {} where {} are expected", name, list.size(), ours.size());
        for (const float value : list)
            if (!std::isfinite(value)) return refuse("{}: not a finite number", name);
        std::copy(list.begin(), list.end(), ours.begin());
    }
    // Ascending, each as its step from the one before.
    void ids(std::vector<ObjectId>& ours, const char* name, auto& steps) {
        ours.reserve(size_of(steps));
        std::uint64_t id = 0;
        for (const std::uint32_t step : steps) {
            if (step == 0 && !ours.empty()) return refuse("{}: ids are not ascending", name);
            id += step;
            if (id >= kMaxObjects) return refuse("{}: object {}, the limit is {}", name, id, kMaxObjects);
            ours.push_back(static_cast<ObjectId>(id));
        }
    }
    // Of any place, and empty ones are all alike.
    void rect(Rect& ours, const char* name, auto& list) {
        if (list.size() != 4) return refuse("{}: one rectangle is expected", name);
        ours = {list[0], list[1], list[2], list[3]};
        if (ours.empty()) ours = {};
    }
    void region(Region& ours, const char* name, auto& list) {
        if (list.size() % 4 != 0) return refuse("{}: {} numbers are no rectangles", place(name), list.size());
        ours.reserve(size_of(list) / 4);
        for (int i = 0; i < list.size(); i += 4) {
            const Rect r{list[i], list[i + 1], list[i + 2], list[i + 3]};
            if (r.empty() || r.x0 < 0 || r.y0 < 0 || r.x1 > kMaxPictureSide || r.y1 > kMaxPictureSide)
                return refuse("{}: a rectangle that is empty or leaves 0 to {}", place(name),
                              kMaxPictureSide);
            ours.push_back(r);
        }
    }
    // Of messages. Their errors name the list.
    void each(auto& ours, const char* name, auto& list, std::size_t limit, const char* what) {
        if (size_of(list) > limit) return refuse("{}: {}{}, the limit is {}", name, list.size(), what, limit);
        ours.resize(size_of(list));
        list_ = name;
        for (std::size_t i = 0; status_ && i < ours.size(); ++i)
            fields(*this, ours[i], *list.Mutable(static_cast<int>(i)));
        list_ = nullptr;
    }

    // What follows from fields that have been read.
    void derived(auto& ours, const auto& value) { ours = value(); }
    // What several fields have to fulfil together.
    void check(const auto& holds) {
        if (status_) status_ = holds();
    }

  private:
    static std::size_t size_of(const auto& list) { return static_cast<std::size_t>(list.size()); }
    const char* place(const char* name) const { return list_ != nullptr ? list_ : name; }
    template <class... Args>
    void refuse(fmt::format_string<Args...> format, Args&&... args) {
        if (status_) status_ = fail(format, std::forward<Args>(args)...);
    }

    Status status_;
    const char* list_ = nullptr;  // the list that is being read
};

}  // namespace swath
