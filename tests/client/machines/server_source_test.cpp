#include "client/machines/server_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/ids.h"

namespace swath {
namespace {

using SourceKind = ServerSource::Kind;
using testing::ElementsAre;
using testing::IsEmpty;

std::string refusal(const std::vector<std::string>& texts) {
    const auto source = parse_server_source(texts);
    return source ? "" : source.error().message;
}

TEST(ServerSource, IsAListAHostNameOrAFile) {
    const auto list = parse_server_source({"a:1", "[::1]:2", "dns:3"});
    ASSERT_TRUE(list.has_value());
    EXPECT_EQ(*list, (ServerSource{SourceKind::kList, {{"a", 1}, {"::1", 2}, {"dns", 3}}, {}, {}}));
    const auto name = parse_server_source({"dns:server:4000"});
    ASSERT_TRUE(name.has_value());
    EXPECT_EQ(*name, (ServerSource{SourceKind::kName, {}, {"server", 4000}, {}}));
    const auto file = parse_server_source({"file:/tmp/a list:1"});
    ASSERT_TRUE(file.has_value());
    EXPECT_EQ(*file, (ServerSource{SourceKind::kFile, {}, {}, "/tmp/a list:1"}));
    for (const auto& source : {list, name, file}) {
        const std::string text = to_string(*source);
        EXPECT_EQ(*parse_server_source(source == list ? std::vector<std::string>{"a:1", "[::1]:2", "dns:3"}
                                                      : std::vector{text}),
                  *source);
    }
    EXPECT_EQ(to_string(*list), "a:1,[::1]:2,dns:3");
    EXPECT_EQ(to_string(*name), "dns:server:4000");
}

TEST(ServerSource, SaysWhatIsWrong) {
    EXPECT_EQ(refusal({"a"}), "address 'a': expected HOST:PORT");
    EXPECT_EQ(refusal({"dns:a:x"}), "address 'a:x': the port must be a number from 0 to 65535");
    EXPECT_EQ(refusal({"dns::4000"}), "address ':4000': expected HOST:PORT");
    EXPECT_EQ(refusal({"dns:a:1", "b:2"}), "'dns:a:1' must be the only one");
    EXPECT_EQ(refusal({"b:2", "file:x"}), "'file:x' must be the only one");
    EXPECT_EQ(refusal({"file:"}), "'file:': expected file:PATH");
    EXPECT_EQ(refusal({"a:1", "b:1", "a:1"}), "'a:1' is there twice");
    std::vector<std::string> many;
    for (std::size_t i = 0; i <= kMaxServers; ++i) many.push_back(fmt::format("a:{}", i));
    EXPECT_EQ(refusal(many), "1025 addresses, the limit is 1024");
}

TEST(ServerList, HasAnAddressALine) {
    const auto list = parse_server_list("# two of them\n\n  a:1  \r\nb:2 # the slow one\n\t\n[::1]:3");
    ASSERT_TRUE(list.has_value()) << list.error().message;
    EXPECT_THAT(*list, ElementsAre(Address{"a", 1}, Address{"b", 2}, Address{"::1", 3}));
    EXPECT_THAT(*parse_server_list(""), IsEmpty());
    EXPECT_THAT(*parse_server_list("#"), IsEmpty());
}

TEST(ServerList, NamesTheLineThatIsWrong) {
    EXPECT_EQ(parse_server_list("a:1\n\nb").error().message, "line 3: address 'b': expected HOST:PORT");
    EXPECT_EQ(parse_server_list("a:1 b:2").error().message,
              "line 1: address 'a:1 b:2': put an IPv6 host in brackets");
    std::string many;
    for (int i = 0; i < 1025; ++i) many += "a:" + std::to_string(i) + "\n";
    EXPECT_EQ(parse_server_list(many).error().message, "line 1025: more than 1024 addresses");
}

}  // namespace
}  // namespace swath
