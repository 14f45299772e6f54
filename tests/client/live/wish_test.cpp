#include "client/live/wish.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace swath {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class WishTest : public testing::Test {
  protected:
    Refusals apply(const std::string& json) {
        const auto refused = apply_wish(json, 5, limits_, wish_);
        EXPECT_TRUE(refused.has_value()) << refused.error().message;
        return refused.value_or(Refusals{});
    }
    // The reason to refuse this one field. Expects that the wish is unchanged but for its sender.
    std::string refusal(const std::string& field, const std::string& value) {
        LiveWish before = wish_;
        const Refusals refused = apply("{\"" + field + "\":" + value + "}");
        before.by = 5;
        EXPECT_EQ(wish_, before) << field << " " << value;
        const auto found = refused.find(field);
        return found == refused.end() ? "not refused" : found->second;
    }
    WishLimits limits_{4, 2000, 1000};
    LiveWish wish_;
};

TEST_F(WishTest, SaysEverythingAtOnce) {
    EXPECT_THAT(apply(R"({"type":"wish","id":7,"camera":[1,2,3,0,0,0,0,1,0,30.5],"width":640,"height":480,
                         "algorithm":"mahd","against":"sort-last","servers":3,"objects":400,"renderer":"egl",
                         "cull":"none","path":"orbit","paused":true,"step":2,"measure":3,"trace":4})"),
                IsEmpty());
    LiveWish expected;
    expected.id = 7;
    expected.by = 5;
    expected.camera = {1, 2, 3, 0, 0, 0, 0, 1, 0, 30.5f};
    expected.width = 640;
    expected.height = 480;
    expected.algorithm = Algorithm::kMahd;
    expected.against = Algorithm::kSortLast;
    expected.servers = 3;
    expected.setup = {400, {{RendererKind::kEgl}, CullAlgorithm::kNone, {}}};
    expected.path = "orbit";
    expected.paused = true;
    expected.step = 2;
    expected.measure = 3;
    expected.trace = 4;
    EXPECT_EQ(wish_, expected);
    EXPECT_THAT(apply(R"({"against":null,"path":null})"), IsEmpty());
    EXPECT_EQ(wish_.against, std::nullopt);
    EXPECT_EQ(wish_.path, "");
}

TEST_F(WishTest, KeepsWhatItDoesNotSay) {
    wish_.servers = 2;
    EXPECT_THAT(apply("{}"), IsEmpty());
    EXPECT_EQ(wish_.servers, 2u);
}

TEST_F(WishTest, IsGivenFieldByFieldAsFarAsItCanBe) {
    const Refusals refused = apply(R"({"servers":9,"algorithm":"kd-split"})");
    EXPECT_EQ(refused, (Refusals{{"servers", "a whole number from 1 to 4 is expected"}}));
    EXPECT_EQ(wish_.algorithm, Algorithm::kKdSplit);
}

TEST_F(WishTest, KeepsTheShapeOfAPictureThatIsTooLarge) {
    apply(R"({"width":4000,"height":3000})");
    EXPECT_EQ(wish_.width, 1333);
    EXPECT_EQ(wish_.height, 1000);
    apply(R"({"width":90000,"height":1})");
    EXPECT_EQ(wish_.width, 2000);
    EXPECT_EQ(wish_.height, 1);
    apply(R"({"width":1999,"height":1000})");
    EXPECT_EQ(wish_.width, 1999);
}

TEST_F(WishTest, OfNoNumberOfServersIsForAllOfThem) {
    apply(R"({"servers":3})");
    EXPECT_EQ(wish_.servers, 3u);
    apply(R"({"servers":null})");
    EXPECT_EQ(wish_.servers, std::nullopt);
}

TEST_F(WishTest, MayHaveRenderersForTheServersInTurn) {
    apply(R"({"renderer":"raycast,osmesa,raycast"})");
    EXPECT_THAT(wish_.setup.draw.renderers,
                testing::ElementsAre(RendererKind::kRaycast, RendererKind::kOsmesa, RendererKind::kRaycast));
    apply(R"({"renderer":"egl"})");
    EXPECT_THAT(wish_.setup.draw.renderers, testing::ElementsAre(RendererKind::kEgl));
}

TEST_F(WishTest, RefusesValuesOfAnotherKindOrBeyondTheLimits) {
    for (const char* value : {"-1", "1.5", "\"1\"", "[]", "{}", "true", "18446744073709551615", "0"})
        EXPECT_EQ(refusal("servers", value), "a whole number from 1 to 4 is expected") << value;
    EXPECT_EQ(refusal("objects", "1000001"), "a whole number from 1 to 1000000 is expected");
    EXPECT_THAT(refusal("id", "1e300"), HasSubstr("a whole number"));
    EXPECT_THAT(refusal("algorithm", "\"magic\""), HasSubstr("'magic' is not known"));
    EXPECT_EQ(refusal("algorithm", "3"), "a name is expected");
    EXPECT_THAT(refusal("against", "\"\""), HasSubstr("not known"));
    EXPECT_THAT(refusal("renderer", "\"vulkan\""), HasSubstr("there are: raster, osmesa, egl, raycast"));
    EXPECT_THAT(refusal("renderer", "\"osmesa,\""), HasSubstr("renderer '' is not known"));
    EXPECT_THAT(refusal("cull", "\"some\""), HasSubstr("'some' is not known"));
    EXPECT_THAT(refusal("path", "\"/etc/passwd\""), HasSubstr("there are: orbit, random"));
    EXPECT_EQ(refusal("paused", "1"), "true or false is expected");
}

TEST_F(WishTest, RefusesCamerasThatNobodyCanLookThrough) {
    EXPECT_EQ(refusal("camera", "[1,2,3]"), "10 numbers are expected");
    EXPECT_EQ(refusal("camera", "[1,2,3,0,0,0,0,1,0,\"x\"]"), "10 numbers are expected");
    EXPECT_EQ(refusal("camera", "[1,2,3,1,2,3,0,1,0,30]"), "eye and target are the same point");
    EXPECT_THAT(refusal("camera", "[1e300,2,3,0,0,0,0,1,0,30]"), HasSubstr("is not within"));
    EXPECT_THAT(refusal("camera", "[1,2,3,0,0,0,0,1,0,180]"), HasSubstr("fov_degrees"));
}

TEST_F(WishTest, IsNoneWithoutAnObject) {
    for (const char* text :
         {"", "null", "[1]", "\"wish\"", "{", "{\"id\":1}}", "\xff\xfe", "{\"id\":\"\xff\"}"})
        EXPECT_FALSE(apply_wish(text, 1, limits_, wish_).has_value()) << text;
}

TEST_F(WishTest, OfRandomBytesIsRefusedOrAWish) {
    std::mt19937 random(3);
    const std::string good =
        R"({"id":7,"camera":[1,2,3,0,0,0,0,1,0,30.5],"width":640,"height":480,"servers":3})";
    for (int i = 0; i < 5000; ++i) {
        std::string text = good;
        for (unsigned k = 0; k < 1 + random() % 4; ++k)
            text[random() % text.size()] = static_cast<char>(random());
        (void)apply_wish(text, 1, limits_, wish_);
        ASSERT_TRUE(camera_of(wish_.camera));
        ASSERT_TRUE(wish_.width >= 1 && wish_.width <= 2000 && wish_.height >= 1 && wish_.height <= 1000);
        ASSERT_TRUE(!wish_.servers || (*wish_.servers >= 1 && *wish_.servers <= 4));
    }
}

}  // namespace
}  // namespace swath
