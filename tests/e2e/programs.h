#pragma once
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/drawings.h"
#include "tests/support/models.h"
#include "tests/support/process.h"

namespace swath::test {

// Sanitizers slow programs down; all our limits are multiplied by this.
inline constexpr int kSlowdown = SWATH_E2E_SLOWDOWN;
inline constexpr std::chrono::milliseconds kPatience = kSlowdown * std::chrono::seconds(60);

using Arguments = std::vector<std::string>;
Arguments operator+(Arguments left, const Arguments& right);

class RemoteCluster;

// A folder for the test's files, the programs, and at the end a check that no process is left.
class EndToEnd : public testing::Test {
  protected:
    EndToEnd();
    ~EndToEnd() override;
    void TearDown() override;

    // Starts "swath-client", "swath-server", "swath-display" or "swath-sim". It draws without extra threads
    // and keeps its cache in the test's folder. Under a sanitizer it waits longer for silent peers, unless
    // the arguments say how long.
    std::unique_ptr<Process> start(const std::string& program, Arguments arguments,
                                   const std::filesystem::path& folder = {}) const;
    Finished run(const std::string& program, const Arguments& arguments,
                 std::chrono::milliseconds limit = kPatience) const;
    Finished client(const Arguments& arguments) const { return run("swath-client", arguments); }
    // Expects exit code 0; returns the folder of the pictures, a new one.
    std::string render(const Arguments& arguments);
    // The same on so many servers, which stay for the calls that follow: starting OpenGL in ten programs takes
    // longer than most of what tests draw.
    std::string render_on(int servers, const Arguments& arguments);

    TemporaryFolder files_;
    static std::string outlasting_;         // programs whose names begin so may outlast a test; empty: none
    std::vector<std::string> environment_;  // of what is started from now on, "NAME=VALUE"

  private:
    static std::vector<pid_t> left_over();

    int renders_ = 0;
    std::unique_ptr<RemoteCluster> cluster_;
};

// A swath-display and swath-servers as somebody would start them by hand, each on a free port. All end with
// the object.
class RemoteCluster {
  public:
    using Start = std::function<std::unique_ptr<Process>(const std::string&, const Arguments&)>;
    RemoteCluster(Start start, int servers);

    // Starts servers until there are so many.
    void grow(int servers);
    // Tells all to end, and expects that they do so without a complaint.
    void stop();

    // The client's flags for this cluster, or for its first servers.
    Arguments flags() const { return flags(servers_.size()); }
    Arguments flags(std::size_t servers) const;
    Process& server(std::size_t i) { return *servers_.at(i); }
    Process& display() { return *display_; }
    const std::string& server_address(std::size_t i) const { return server_addresses_.at(i); }
    const std::string& display_address() const { return display_address_; }

  private:
    Start start_;
    std::unique_ptr<Process> display_;
    std::string display_address_;
    std::vector<std::unique_ptr<Process>> servers_;
    std::vector<std::string> server_addresses_;
};

// The address that a server or display prints.
std::string listening_address(Process& process);

std::vector<std::string> file_names(const std::filesystem::path& folder);  // sorted
std::string contents(const std::filesystem::path& file);

// Expects the same files in both folders, at least one, byte for byte. Tells differences in pixels.
void expect_same_pictures(const std::filesystem::path& expected, const std::filesystem::path& actual);
// Expects that every picture in the folder has only this colour.
void expect_only(std::array<std::uint8_t, 3> colour, const std::filesystem::path& folder);
void expect_not_only(std::array<std::uint8_t, 3> colour, const std::filesystem::path& folder);

// Expects no message of a sanitizer, assertion or exception.
void expect_no_crash(const Finished& finished);
// Expects this exit code and exactly one line that starts with "error: ", and all these words in it.
void expect_one_error(const Finished& finished, int exit_code, const std::vector<std::string>& words);

}  // namespace swath::test
