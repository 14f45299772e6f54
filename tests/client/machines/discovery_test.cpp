#include "client/machines/discovery.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/models.h"
#include "tests/support/wire_peer.h"

namespace swath::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class DiscoveryTest : public testing::Test {
  protected:
    void discover(const std::string& source) {
        discovery_ = std::make_unique<Discovery>(
            loop_.io, *parse_server_source({source}),
            [this](const Result<std::vector<Address>>& found) { answers_.push_back(found); });
        discovery_->start();
    }
    Result<std::vector<Address>> next() {
        loop_.run_until([&] { return !answers_.empty(); });
        auto answer = answers_.front();
        answers_.clear();
        return answer;
    }

    Loop loop_;
    TemporaryFolder files_;
    std::vector<Result<std::vector<Address>>> answers_;
    std::unique_ptr<Discovery> discovery_;
};

TEST_F(DiscoveryTest, OfAListIsTheListAgainAndAgain) {
    discover("b:2");
    EXPECT_THAT(*next(), ElementsAre(Address{"b", 2}));
    EXPECT_THAT(*next(), ElementsAre(Address{"b", 2}));
}

TEST_F(DiscoveryTest, OfANameIsItsAddresses) {
    discover("dns:localhost:4000");
    EXPECT_THAT(*next(),
                testing::AnyOf(ElementsAre(Address{"127.0.0.1", 4000}), ElementsAre(Address{"::1", 4000})));
}

TEST_F(DiscoveryTest, SaysThatANameIsUnknownAndAsksAgain) {
    discover("dns:no-such-host.invalid:4000");
    EXPECT_THAT(next().error().message, HasSubstr("no-such-host.invalid: "));
    EXPECT_FALSE(next().has_value());
}

TEST_F(DiscoveryTest, ReadsAFileAgain) {
    const std::string file = files_.write("list", "a:1\nb:2\na:1\n");
    discover("file:" + file);
    EXPECT_THAT(*next(), ElementsAre(Address{"a", 1}, Address{"b", 2}));
    files_.write("list", "");
    EXPECT_THAT(*next(), IsEmpty());
    files_.write("list", "c");
    EXPECT_EQ(next().error().message, file + ": line 1: address 'c': expected HOST:PORT");
    std::filesystem::remove(file);
    EXPECT_THAT(next().error().message, HasSubstr(file));
    files_.write("list", "c:3");
    EXPECT_THAT(*next(), ElementsAre(Address{"c", 3}));
}

TEST_F(DiscoveryTest, EndsWithTheObject) {
    discover("dns:localhost:4000");
    discovery_.reset();
    loop_.io.run();
    EXPECT_THAT(answers_, IsEmpty());
}

}  // namespace
}  // namespace swath::test
