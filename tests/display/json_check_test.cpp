#include "display/view/json_check.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <string>

namespace swath {
namespace {

bool accepts(std::string_view text) {
    return is_json_object({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

const std::string kSample =
    R"({"type":"frame", "a":[1,-2.5e3,0,0.1,[],{}], "b":{"c":null,"d":true,"e":false},"f":"\"\\\n\u00e9",)"
    "\"g\":\"\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\",\r\n\t \"\":\"\"}";

TEST(JsonCheck, TakesObjectsOnly) {
    EXPECT_TRUE(accepts("{}"));
    EXPECT_TRUE(accepts(kSample));
    EXPECT_TRUE(accepts(" \n{} \t\r"));
    for (const char* text : {"", " ", "[]", "1", "null", "\"{}\"", "{}{}", "{", "}", "{]"})
        EXPECT_FALSE(accepts(text)) << text;
}

TEST(JsonCheck, RefusesWhatNestsTooDeeply) {
    const auto nested = [](int depth) {
        const auto n = static_cast<std::size_t>(depth);
        return "{\"a\":" + std::string(n, '[') + std::string(n, ']') + "}";
    };
    EXPECT_TRUE(accepts(nested(kMaxJsonDepth - 1)));
    EXPECT_FALSE(accepts(nested(kMaxJsonDepth)));
    EXPECT_FALSE(accepts("{\"a\":" + std::string(1'000'000, '[')));
}

// Bytes are changed, left out and doubled at random; the library that parses in earnest says what is right.
// It is stricter than RFC 8259 about lone surrogates and numbers that are too large.
TEST(JsonCheck, AgreesWithAParserOnDamagedTexts) {
    std::mt19937 random(7);
    const std::string alphabet =
        "{}[]\",:\\/0123456789.-+eEtrufalsn \n\x01\x1f\x7f\x80\xc0\xc2\xe0\xed\xf0\xf4\xff";
    int well_formed = 0;
    for (int round = 0; round < 50'000; ++round) {
        std::string text = kSample;
        for (auto changes = 1 + random() % 3; changes > 0; --changes) {
            const std::size_t at = random() % text.size();
            const std::size_t kind = random() % 3;
            if (kind == 0) text[at] = alphabet[random() % alphabet.size()];
            if (kind == 1) text.erase(at, 1);
            if (kind == 2) text.insert(at, 1, text[at]);
        }
        const bool parses = text.starts_with('{') && text.ends_with('}') && nlohmann::json::accept(text);
        well_formed += parses;
        if (accepts(text) == parses) continue;
        ASSERT_FALSE(parses) << text;
        ASSERT_TRUE(text.find("\\u") != std::string::npos || text.find_first_of("eE") != std::string::npos)
            << text;
    }
    EXPECT_GT(well_formed, 2'500);
}

}  // namespace
}  // namespace swath
