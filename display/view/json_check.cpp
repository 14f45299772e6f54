#include "display/view/json_check.h"

#include <cstddef>
#include <string_view>

namespace swath {
namespace {

bool is_digit(int c) { return c >= '0' && c <= '9'; }
bool is_hex(int c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }

// Each function takes what it is named after and says whether that was there.
class Checker {
  public:
    explicit Checker(std::span<const std::uint8_t> bytes)
        : at_(bytes.data()), end_(bytes.data() + bytes.size()) {}

    bool whole_object() {
        space();
        if (peek() != '{' || !value(0)) return false;
        space();
        return at_ == end_;
    }

  private:
    static constexpr int kEnd = -1;
    int peek() const { return at_ == end_ ? kEnd : *at_; }
    bool take(int c) {
        if (peek() != c) return false;
        ++at_;
        return true;
    }
    void space() {
        while (at_ != end_ && (*at_ == ' ' || *at_ == '\n' || *at_ == '\r' || *at_ == '\t')) ++at_;
    }

    bool value(int depth) {
        switch (peek()) {
            case '{':
                return depth < kMaxJsonDepth && members('}', true, depth);
            case '[':
                return depth < kMaxJsonDepth && members(']', false, depth);
            case '"':
                return string();
            case 't':
                return word("true");
            case 'f':
                return word("false");
            case 'n':
                return word("null");
            default:
                return number();
        }
    }

    // An object or an array.
    bool members(char close, bool named, int depth) {
        ++at_;
        space();
        if (take(close)) return true;
        for (;;) {
            if (named) {
                if (!string()) return false;
                space();
                if (!take(':')) return false;
                space();
            }
            if (!value(depth + 1)) return false;
            space();
            if (take(close)) return true;
            if (!take(',')) return false;
            space();
        }
    }

    bool word(std::string_view letters) {
        for (const char c : letters)
            if (!take(c)) return false;
        return true;
    }

    bool digits() {
        if (!is_digit(peek())) return false;
        while (is_digit(peek())) ++at_;
        return true;
    }
    bool number() {
        take('-');
        if (!take('0') && !digits()) return false;
        if (take('.') && !digits()) return false;
        if (!take('e') && !take('E')) return true;
        if (!take('+')) take('-');
        return digits();
    }

    bool string() {
        if (!take('"')) return false;
        while (at_ != end_) {
            const std::uint8_t c = *at_;
            if (c < 0x20) return false;
            if (c >= 0x80) {
                if (!beyond_ascii()) return false;
                continue;
            }
            ++at_;
            if (c == '"') return true;
            if (c == '\\' && !escaped()) return false;
        }
        return false;
    }
    bool escaped() {
        if (take('u')) {
            for (int i = 0; i < 4; ++i, ++at_)
                if (!is_hex(peek())) return false;
            return true;
        }
        if (at_ == end_) return false;
        return std::string_view("\"\\/bfnrt").find(static_cast<char>(*at_++)) != std::string_view::npos;
    }
    // A character of two to four bytes, in its shortest form and no surrogate (RFC 3629).
    bool beyond_ascii() {
        const std::uint8_t first = *at_++;
        if (first < 0xc2 || first > 0xf4) return false;
        const int more = first < 0xe0 ? 1 : first < 0xf0 ? 2 : 3;
        std::uint8_t low = 0x80;  // of the second byte
        std::uint8_t high = 0xbf;
        if (first == 0xe0) low = 0xa0;
        if (first == 0xed) high = 0x9f;
        if (first == 0xf0) low = 0x90;
        if (first == 0xf4) high = 0x8f;
        for (int i = 0; i < more; ++i, ++at_) {
            if (at_ == end_ || *at_ < low || *at_ > high) return false;
            low = 0x80;
            high = 0xbf;
        }
        return true;
    }

    const std::uint8_t* at_;
    const std::uint8_t* end_;
};

}  // namespace

bool is_json_object(std::span<const std::uint8_t> bytes) { return Checker(bytes).whole_object(); }

}  // namespace swath
