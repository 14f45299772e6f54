#include "common/base/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <string_view>
#include <vector>

namespace swath {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// Each test has a folder, which is removed at its end.
class File : public testing::Test {
  protected:
    File() {
        std::string name = (fs::temp_directory_path() / "swath-file-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
        folder_ = name;
    }
    ~File() override {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }

    Status write(const fs::path& path, std::string_view text) {
        return write_file(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    }
    std::string read(const fs::path& path, std::uint64_t limit = 1000) {
        const Result<Buffer> bytes = read_file(path, limit);
        if (!bytes) return "error: " + bytes.error().message;
        return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
    }
    std::vector<std::string> names_in(const fs::path& folder) {
        std::vector<std::string> names;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder))
            names.push_back(entry.path().filename().string());
        return names;
    }

    fs::path folder_;
};

TEST_F(File, ReadsBackWhatWasWritten) {
    ASSERT_TRUE(write(folder_ / "plan", std::string_view("a\0b\n", 4)).has_value());
    EXPECT_EQ(read(folder_ / "plan"), std::string("a\0b\n", 4));
}

TEST_F(File, ReplacesAFileAndLeavesNoOther) {
    ASSERT_TRUE(write(folder_ / "plan", "a long first version").has_value());
    ASSERT_TRUE(write(folder_ / "plan", "second").has_value());
    EXPECT_EQ(read(folder_ / "plan"), "second");
    EXPECT_THAT(names_in(folder_), testing::ElementsAre("plan"));
}

TEST_F(File, MakesMissingFolders) {
    ASSERT_TRUE(write(folder_ / "a" / "b" / "c", "deep").has_value());
    EXPECT_EQ(read(folder_ / "a" / "b" / "c"), "deep");
}

TEST_F(File, MayBeEmpty) {
    ASSERT_TRUE(write(folder_ / "empty", "").has_value());
    EXPECT_EQ(read(folder_ / "empty"), "");
}

TEST_F(File, CanBeReadByOthersThanItsWriter) {
    ASSERT_TRUE(write(folder_ / "picture", "x").has_value());
    EXPECT_EQ(fs::status(folder_ / "picture").permissions(), fs::perms(0644));
}

TEST_F(File, ThatCannotBePutInPlaceLeavesNothingBehind) {
    fs::create_directories(folder_ / "taken" / "inside");
    const Status status = write(folder_ / "taken", "x");
    ASSERT_FALSE(status.has_value());
    EXPECT_THAT(status.error().message, HasSubstr((folder_ / "taken").string()));
    EXPECT_THAT(names_in(folder_), testing::ElementsAre("taken"));
    EXPECT_THAT(names_in(folder_ / "taken"), testing::ElementsAre("inside"));
}

TEST_F(File, WhoseFolderIsAFileIsAnError) {
    ASSERT_TRUE(write(folder_ / "file", "kept").has_value());
    const Status status = write(folder_ / "file" / "child", "x");
    ASSERT_FALSE(status.has_value());
    EXPECT_THAT(status.error().message, HasSubstr((folder_ / "file").string()));
    EXPECT_EQ(read(folder_ / "file"), "kept");
}

TEST_F(File, ThatIsMissingIsAnErrorWithItsName) {
    const std::string answer = read(folder_ / "missing.ply");
    EXPECT_THAT(answer, HasSubstr("missing.ply"));
    EXPECT_THAT(answer, HasSubstr("No such file"));
}

TEST_F(File, OverTheLimitIsAnErrorThatNamesBothSizes) {
    ASSERT_TRUE(write(folder_ / "big", "0123456789").has_value());
    EXPECT_EQ(read(folder_ / "big", 10), "0123456789");
    EXPECT_THAT(read(folder_ / "big", 9), HasSubstr("10 bytes, the limit is 9"));
}

TEST_F(File, ThatIsAFolderIsAnError) {
    EXPECT_THAT(read(folder_), HasSubstr("not a regular file"));
    EXPECT_THAT(read("/dev/zero"), HasSubstr("not a regular file"));
}

TEST_F(File, ThatIsAPipeIsAnErrorAndNobodyWaitsForAWriter) {
    const fs::path pipe = folder_ / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THAT(read(pipe), HasSubstr("not a regular file"));
}

}  // namespace
}  // namespace swath
