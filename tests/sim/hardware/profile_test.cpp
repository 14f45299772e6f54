#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "common/base/file.h"
#include "sim/hardware/hardware.h"
#include "sim/hardware/keys.h"

namespace swath::sim {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string text_of(const std::string& name) {
    const Result<Buffer> file = read_file(SWATH_SOURCE_DIR "/sim/hardware/" + name, 1 << 20);
    EXPECT_TRUE(file) << file.error().message;
    return file ? std::string(file->bytes().begin(), file->bytes().end()) : "";
}

std::string profile_error(std::string_view toml) {
    const Result<Hardware> hardware = parse_hardware(toml, "mine");
    return hardware ? "no error" : hardware.error().message;
}

std::string_view needed(const Key& key) {
    switch (key.need) {
        case Need::kAlways:
            return "yes";
        case Need::kForGraphics:
            return "for `\"graphics\"`";
        case Need::kForHost:
            return "for `\"host\"`";
        case Need::kOptional:
            break;
    }
    return "no";
}

// The error of paper-2000 with these lines in place of its own.
std::string error_with(const std::string& lines) { return profile_error("base = \"paper-2000\"\n" + lines); }

Hardware paper_with(const std::string& lines) {
    const Result<Hardware> hardware = parse_hardware("base = \"paper-2000\"\n" + lines, "mine");
    EXPECT_TRUE(hardware) << hardware.error().message;
    return hardware.value_or(Hardware{});
}

TEST(Profile, OfThePaperHasTheParametersOfSection7) {
    const Result<Hardware> found = find_hardware("paper-2000");
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(found->name, "paper-2000");
    EXPECT_NEAR(found->network.latency_s, 20e-6, 1e-15);
    EXPECT_DOUBLE_EQ(found->network.bytes_per_s, 100e6);
    EXPECT_FALSE(found->network.core_bytes_per_s);
    EXPECT_EQ(found->network.active_share, 1);
    EXPECT_NEAR(found->server.polygon_s, 1.33e-6, 1e-15);
    EXPECT_DOUBLE_EQ(found->server.fill_pixels_per_s, 300e6);
    EXPECT_FALSE(found->server.culls);
    EXPECT_EQ(found->server.compositing, Compositing::kGraphics);
    for (const BufferAccess& buffer : {found->server.colour, found->server.depth}) {
        EXPECT_NEAR(buffer.read_s(20000), 50e-6 + 1e-3, 1e-12);
        EXPECT_NEAR(buffer.write_s(20000), 50e-6 + 2e-3, 1e-12);
    }
    EXPECT_NEAR(found->display.colour.write_s(20000), 50e-6 + 1e-3, 1e-12);
    EXPECT_EQ(found->network.swath_bytes_per_pixel, 8);
    EXPECT_EQ(found->network.tile_bytes_per_pixel, 4);
}

TEST(Profile, EveryBuiltInOneReadsBackFromItsOwnFile) {
    EXPECT_FALSE(builtin_hardware().empty());
    for (const std::string& name : builtin_hardware()) {
        const Result<Hardware> built_in = find_hardware(name);
        const Result<Hardware> file = find_hardware(SWATH_SOURCE_DIR "/sim/hardware/" + name + ".toml");
        ASSERT_TRUE(built_in) << built_in.error().message;
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_EQ(explain(*built_in), explain(*file));
        EXPECT_THAT(explain(*file), StartsWith(name + ": "));
    }
}

TEST(Profile, OfTheEthernetsDifferInBandwidthAlone) {
    EXPECT_EQ(builtin_hardware(),
              (std::vector<std::string>{"paper-2000", "gbe-2026", "10gbe-2026", "100gbe-2026"}));
    Hardware slow = find_hardware("gbe-2026").value();
    EXPECT_DOUBLE_EQ(slow.network.bytes_per_s, 117.5e6);
    EXPECT_EQ(slow.server.compositing, Compositing::kHost);
    EXPECT_TRUE(slow.server.culls);
    for (const auto& [name, factor] : {std::pair{"10gbe-2026", 10.0}, {"100gbe-2026", 100.0}}) {
        const Hardware fast = find_hardware(name).value();
        EXPECT_DOUBLE_EQ(fast.network.bytes_per_s, factor * slow.network.bytes_per_s);
        Hardware same = slow;
        same.name = fast.name;
        same.about = fast.about;
        same.network.bytes_per_s = fast.network.bytes_per_s;
        EXPECT_EQ(explain(same), explain(fast));
    }
}

TEST(Profile, CanChangeAFewValuesOfABuiltInOne) {
    const Hardware mine = paper_with("[network]\nbandwidth = \"1 Gbit/s\"\ncore_bandwidth = \"2.5 GB/s\"\n");
    EXPECT_EQ(mine.name, "mine");
    EXPECT_EQ(mine.about, "paper-2000 with network.bandwidth, network.core_bandwidth changed");
    EXPECT_DOUBLE_EQ(mine.network.bytes_per_s, 125e6);
    EXPECT_DOUBLE_EQ(mine.network.core_bytes_per_s.value_or(0), 2.5e9);
    EXPECT_NEAR(mine.network.latency_s, 20e-6, 1e-15);
    EXPECT_EQ(paper_with("about = \"faster\"").about, "faster");
}

TEST(Profile, AllowsNoLatencyAtAllAndSharesAsBareNumbers) {
    const Hardware mine = paper_with("network.latency = \"0 us\"\nnetwork.active_share = 0.25\n");
    EXPECT_EQ(mine.network.latency_s, 0);
    EXPECT_EQ(mine.network.active_share, 0.25);
}

TEST(Profile, ThatCompositesOnTheHostNeedsTheRatesOfThat) {
    EXPECT_EQ(error_with("[server]\ncompositing = \"host\"\nmerge = \"1 Gpixel/s\"\n"),
              "mine: server.pack is missing, expected e.g. \"20 Mpixel/s\"");
    const Hardware mine =
        paper_with("[server]\ncompositing = \"host\"\nmerge = \"1 Gpixel/s\"\npack = \"500 Mpixel/s\"\n");
    EXPECT_EQ(mine.server.compositing, Compositing::kHost);
    EXPECT_DOUBLE_EQ(mine.server.pack_pixels_per_s, 500e6);
    EXPECT_DOUBLE_EQ(mine.server.merge_pixels_per_s, 1e9);
}

TEST(Profile, ThatCompositesOnTheHostNeedsNoRatesOfWriting) {
    std::string paper = text_of("paper-2000.toml");
    const std::string graphics = "compositing = \"graphics\"";
    std::string host = paper;
    host.replace(host.find(graphics), graphics.size(),
                 "compositing = \"host\"\npack = \"1 Gpixel/s\"\nmerge = \"1 Gpixel/s\"");
    for (std::string* text : {&paper, &host})
        text->erase(text->find("write = "), std::string("write = \"10 Mpixel/s\"").size());
    EXPECT_EQ(profile_error(paper), "mine: server.colour.write is missing, expected e.g. \"20 Mpixel/s\"");
    EXPECT_EQ(profile_error(host), "no error");
}

TEST(Profile, WithoutABaseNeedsEveryKeyThatIsNotOptional) {
    const std::string paper = text_of("paper-2000.toml");
    EXPECT_EQ(profile_error(paper), "no error");
    std::size_t removed = 0;
    std::string section;
    for (std::size_t begin = 0, end = 0; begin < paper.size(); begin = end + 1) {
        end = paper.find('\n', begin);
        const std::string line = paper.substr(begin, end - begin);
        if (line.starts_with('[')) section = line.substr(1, line.find(']') - 1) + ".";
        if (line.empty() || line.starts_with('[') || line.starts_with('#')) continue;
        const std::string key = section + line.substr(0, line.find(' '));
        const std::string error = profile_error(paper.substr(0, begin) + paper.substr(end));
        if (key == "client.partition_per_server")
            EXPECT_EQ(error, "no error");
        else
            EXPECT_THAT(error, StartsWith("mine: " + key + " is missing, expected e.g. "));
        ++removed;
    }
    EXPECT_EQ(removed, 21u);
}

TEST(Profile, NamesTheLineTheKeyAndTheExpectationOfABadValue) {
    const std::string in_network = "[network]\n";
    EXPECT_EQ(error_with(in_network + "bandwidth = 100"),
              "mine:3: network.bandwidth: 100 has no unit, expected e.g. \"100 MB/s\"");
    EXPECT_EQ(error_with(in_network + "bandwidth = \"100\""),
              "mine:3: network.bandwidth: 100 has no unit, expected e.g. \"100 MB/s\"");
    EXPECT_EQ(error_with(in_network + "bandwidth = \"20 us\""),
              "mine:3: network.bandwidth: \"20 us\" is a time, expected bytes a second, e.g. \"100 MB/s\"");
    EXPECT_EQ(error_with(in_network + "latency = \"20 Us\""),
              "mine:3: network.latency: \"20 Us\" has an unknown unit 'Us', expected e.g. \"20 us\"");
    EXPECT_EQ(error_with(in_network + "latency = \"soon\""),
              "mine:3: network.latency: \"soon\" is not a number with a unit, expected e.g. \"20 us\"");
    EXPECT_EQ(error_with(in_network + "latency = \"nan us\""),
              "mine:3: network.latency: \"nan us\" is not a number with a unit, expected e.g. \"20 us\"");
    EXPECT_EQ(error_with(in_network + "latency = \"-1 us\""),
              "mine:3: network.latency: \"-1 us\" is not zero or more");
    EXPECT_EQ(error_with(in_network + "latency = \"20 s\""),
              "mine:3: network.latency: \"20 s\" is not within 1 ns and 10 s");
    EXPECT_EQ(error_with(in_network + "bandwidth = \"0 MB/s\""),
              "mine:3: network.bandwidth: \"0 MB/s\" is not more than zero");
    EXPECT_EQ(error_with(in_network + "bandwidth = \"-1 MB/s\""),
              "mine:3: network.bandwidth: \"-1 MB/s\" is not more than zero");
    EXPECT_EQ(error_with(in_network + "bandwidth = \"1e300 MB/s\""),
              "mine:3: network.bandwidth: \"1e300 MB/s\" is not within 1 kB/s and 100000 GB/s");
    EXPECT_EQ(error_with(in_network + "active_share = 1.5"),
              "mine:3: network.active_share: \"1.5\" is not within 1e-06 and 1");
    EXPECT_EQ(error_with(in_network + "active_share = nan"),
              "mine:3: network.active_share: \"nan\" is not a number with a unit, expected e.g. \"0.5\"");
    EXPECT_EQ(error_with(in_network + "latency = true"),
              "mine:3: network.latency: true or false, expected e.g. \"20 us\"");
    EXPECT_EQ(error_with(in_network + "latency = [\"20 us\"]"),
              "mine:3: network.latency: an array, expected e.g. \"20 us\"");
    EXPECT_EQ(error_with(in_network + "latency.min = \"20 us\""),
              "mine:3: network.latency: a table, expected e.g. \"20 us\"");
    EXPECT_EQ(error_with("server.culls = \"yes\""), "mine:2: server.culls: a text, expected true or false");
    EXPECT_EQ(error_with("server.compositing = \"gpu\""),
              "mine:2: server.compositing: \"gpu\", expected \"graphics\" or \"host\"");
    EXPECT_EQ(error_with("server.compositing = 1"),
              "mine:2: server.compositing: a number, expected \"graphics\" or \"host\"");
    EXPECT_EQ(error_with("about = 2000-01-01"), "mine:2: about: a date or time, expected a text");
    EXPECT_EQ(error_with("about = \"\""), "mine:2: about: expected one line of 1 to 200 bytes");
    EXPECT_EQ(error_with("about = \"a bell\\u0007\""), "mine:2: about: expected one line of 1 to 200 bytes");
    EXPECT_EQ(error_with("about = \"two\\nlines\""), "mine:2: about: expected one line of 1 to 200 bytes");
}

TEST(Profile, NamesAnUnknownKeyAndTheNearestOne) {
    EXPECT_EQ(error_with("[network]\n\nbandwith = \"1 MB/s\""),
              "mine:4: unknown key 'network.bandwith': did you mean 'network.bandwidth'?");
    EXPECT_EQ(error_with("[netwok]\nlatency = \"1 us\""),
              "mine:2: unknown key 'netwok': there are base, about, network.latency" +
                  error_with("x = 1").substr(error_with("x = 1").find(", network.bandwidth")));
    EXPECT_THAT(error_with("gpu = true"), StartsWith("mine:2: unknown key 'gpu': there are base, about, "));
    EXPECT_EQ(error_with("network = 5"), "mine:2: network: a number, expected the table [network]");
    EXPECT_THAT(error_with(std::string(5000, 'k') + " = 1"), HasSubstr("there are base, about"));
}

TEST(Profile, NamesTheLineOfBrokenToml) {
    EXPECT_THAT(profile_error("about = \"x\"\n[network\n"), StartsWith("mine:2: "));
    EXPECT_THAT(profile_error("about = \"x\"\nabout = \"y\"\n"), StartsWith("mine:2: "));
    EXPECT_THAT(profile_error("about = \"\xff\"\n"), StartsWith("mine:1: "));
}

TEST(Profile, IsBasedOnBuiltInOnesOnly) {
    EXPECT_THAT(profile_error("base = \"paper-2001\""),
                StartsWith("mine:1: base: \"paper-2001\", expected one of paper-2000"));
    EXPECT_THAT(profile_error("base = 2000"),
                StartsWith("mine:1: base: a number, expected one of paper-2000"));
}

TEST(Profile, ThatIsNotKnownIsAnErrorThatListsTheBuiltInOnes) {
    EXPECT_THAT(find_hardware("paper").error().message,
                StartsWith("unknown hardware 'paper': the built-in profiles are paper-2000"));
    EXPECT_EQ(find_hardware("/no/such.toml").error().message, "/no/such.toml: No such file or directory");
}

TEST(Profile, OfAFileIsNamedAfterItAndItsErrorsNameThePath) {
    const std::string path = testing::TempDir() + "/my cluster.toml";
    std::ofstream(path) << "base = \"paper-2000\"\nserver.fill = \"1 Gpixel/s\"\n";
    EXPECT_EQ(find_hardware(path).value_or(Hardware{}).name, "my cluster");
    std::ofstream(path) << "base = \"paper-2000\"\nserver.fil = \"1 Gpixel/s\"\n";
    EXPECT_THAT(find_hardware(path).error().message, StartsWith(path + ":2: unknown key 'server.fil'"));
}

TEST(Explain, HasALineForEveryKeyWithValueAndMeaning) {
    const std::string text = explain(find_hardware("paper-2000").value());
    for (const Key& key : hardware_keys().subspan(1)) EXPECT_THAT(text, HasSubstr(key.meaning));
    EXPECT_THAT(text, HasSubstr("network.bandwidth            100 MB/s              of each machine's"));
    EXPECT_THAT(text, HasSubstr("server.polygon               1.33 us/polygon "));
    EXPECT_THAT(text, HasSubstr("server.merge                 none "));
    EXPECT_THAT(text, HasSubstr("network.core_bandwidth       none "));
}

TEST(Readme, DocumentsEveryKeyAndNoOther) {
    const std::string readme = text_of("README.md");
    std::string table;
    for (const Key& key : hardware_keys())
        table += fmt::format("| `{}` | `{}` | {} | {} |\n", key.name, example(key), needed(key), key.meaning);
    EXPECT_THAT(readme, HasSubstr("\n|---|---|---|---|\n" + table + "\n")) << "the table should be\n"
                                                                           << table;
}

}  // namespace
}  // namespace swath::sim
