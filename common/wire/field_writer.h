#pragma once
#include <google/protobuf/repeated_field.h>

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/wire/messages.h"

namespace swath {

// Puts fields of ours into protobuf's messages (see fields.h). Limits are the reader's to check.
class FieldWriter {
  public:
    void number(auto ours, const char*, auto, auto set) { set(ours); }
    void at_most(auto ours, const char*, auto, auto set, auto) { set(ours); }
    void below(auto ours, const char*, auto, auto set, auto) { set(ours); }
    void within(auto ours, const char*, auto, auto set, auto, auto) { set(ours); }
    void index(auto ours, const char*, auto, auto set, auto) { set(ours); }
    void named(auto ours, const char*, auto, auto set) { set(ours); }
    void time(Nanoseconds ours, const char*, std::int64_t, auto set) { set(ours.count()); }
    void text(const std::string& ours, const char*, const std::string&, auto set) { set(ours); }
    // For people, so half of a long one is better than none.
    void reason(const std::string& ours, const char*, const std::string&, auto set) {
        set(ours.substr(0, kMaxTextBytes));
    }
    void digest(const Digest& ours, const char*, const std::string&, auto set) {
        set(std::string(ours.begin(), ours.end()));
    }
    void colour(const Rgb& ours, const char*, std::uint32_t, auto set) {
        set(std::uint32_t{ours[0]} << 16 | std::uint32_t{ours[1]} << 8 | ours[2]);
    }

    void each_named(const auto& ours, const char*, auto& list, auto) {
        for (const auto value : ours) list.Add(static_cast<std::uint32_t>(value));
    }
    void numbers(const auto& ours, const char*, auto& list, auto...) { list.Add(ours.begin(), ours.end()); }
    void floats(std::span<const float> ours, const char*, auto& list) { list.Add(ours.begin(), ours.end()); }
    void ids(const std::vector<ObjectId>& ours, const char*, auto& steps) {
        steps.Reserve(static_cast<int>(ours.size()));
        ObjectId previous = 0;
        for (const ObjectId id : ours) steps.Add(id - std::exchange(previous, id));
    }
    void rect(const Rect& ours, const char*, auto& list) {
        for (const int side : {ours.x0, ours.y0, ours.x1, ours.y1}) list.Add(side);
    }
    void region(const Region& ours, const char* name, auto& list) {
        list.Reserve(static_cast<int>(4 * ours.size()));
        for (const Rect& r : ours) rect(r, name, list);
    }
    void each(const auto& ours, const char*, auto& list, auto, auto) {
        for (const auto& one : ours) fields(*this, one, *list.Add());
    }

    void derived(auto, auto) {}
    void check(const auto&) {}
};

}  // namespace swath
