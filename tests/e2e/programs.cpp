#include "tests/e2e/programs.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <sstream>

#include "common/image/picture.h"

namespace swath::test {
namespace {

const Arguments kListen{"--listen", "127.0.0.1:0"};

Picture picture_in(const std::filesystem::path& file) {
    const std::string bytes = contents(file);
    auto picture = decode_png({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    if (!picture) {
        ADD_FAILURE() << file << ": " << picture.error().message;
        return {};
    }
    return *picture;
}

std::string difference(const Picture& expected, const Picture& actual) {
    if (expected.width != actual.width || expected.height != actual.height)
        return fmt::format("{}x{} instead of {}x{}", actual.width, actual.height, expected.width,
                           expected.height);
    std::size_t pixels = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < expected.rgb.size(); i += 3) {
        if (std::equal(&expected.rgb[i], &expected.rgb[i] + 3, &actual.rgb[i])) continue;
        if (pixels++ == 0) first = i / 3;
    }
    const auto width = static_cast<std::size_t>(expected.width);
    return fmt::format("{} pixels differ, the first at {}, {}", pixels, first % width, first / width);
}

bool is_only(const Rgb& colour, const Picture& picture) {
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
        if (!std::equal(colour.begin(), colour.end(), &picture.rgb[i])) return false;
    return true;
}

}  // namespace

Arguments operator+(Arguments left, const Arguments& right) {
    left.insert(left.end(), right.begin(), right.end());
    return left;
}

EndToEnd::EndToEnd() { adopt_orphans(); }

std::string EndToEnd::outlasting_;

EndToEnd::~EndToEnd() {
    for (const pid_t pid : left_over()) ::kill(pid, SIGKILL);
}

std::vector<pid_t> EndToEnd::left_over() {
    std::vector<pid_t> left = living_descendants(::getpid());
    if (!outlasting_.empty())
        std::erase_if(left, [](pid_t pid) { return program_of(pid).starts_with(outlasting_); });
    return left;
}

void EndToEnd::TearDown() {
    if (cluster_) cluster_->stop();
    std::vector<std::string> left;
    for (const pid_t pid : left_over()) left.push_back(program_of(pid));
    EXPECT_TRUE(left.empty()) << "still running: " << fmt::format("{}", fmt::join(left, ", "));
}

std::unique_ptr<Process> EndToEnd::start(const std::string& program, Arguments arguments,
                                         const std::filesystem::path& folder) const {
    const bool has_peers = program != "swath-sim";
    if (kSlowdown > 1 && has_peers &&
        std::find(arguments.begin(), arguments.end(), "--silence-ms") == arguments.end())
        arguments = Arguments{"--silence-ms", "10000"} + arguments;
    return std::make_unique<Process>(
        std::filesystem::path(SWATH_PROGRAMS) / program, arguments,
        Process::Options{Arguments{"LP_NUM_THREADS=0", "XDG_CACHE_HOME=" + files_.path_of("cache"),
                                   // All tests compile the same few shaders.
                                   "MESA_SHADER_CACHE_DIR=" SWATH_PROGRAMS "/../tests/shaders"} +
                             environment_,
                         folder});
}

Finished EndToEnd::run(const std::string& program, const Arguments& arguments,
                       std::chrono::milliseconds limit) const {
    Finished finished = start(program, arguments)->wait(limit);
    expect_no_crash(finished);
    return finished;
}

std::string EndToEnd::render(const Arguments& arguments) {
    std::string folder = files_.path_of(fmt::format("pictures_{}", renders_++));
    const Finished finished = client(arguments + Arguments{"--out", folder});
    EXPECT_EQ(finished.exit_code, 0) << fmt::format("{}\n{}", fmt::join(arguments, " "), finished.err);
    return folder;
}

std::string EndToEnd::render_on(int servers, const Arguments& arguments) {
    if (!cluster_)
        cluster_ = std::make_unique<RemoteCluster>(
            [this](const std::string& program, const Arguments& all) { return start(program, all); },
            servers);
    cluster_->grow(servers);
    Arguments all = arguments + cluster_->flags(static_cast<std::size_t>(servers));
    // The client would start OpenGL only to see that it works.
    if (std::find(all.begin(), all.end(), "--renderer") == all.end())
        all = all + Arguments{"--renderer", std::string(name_of(gl_here()))};
    return render(all);
}

std::string listening_address(Process& process) {
    static constexpr std::string_view kAnnouncement = "listening ";
    return process.wait_for_line("listening 127.0.0.1:", kPatience).substr(kAnnouncement.size());
}

RemoteCluster::RemoteCluster(Start start, int servers)
    : start_(std::move(start)), display_(start_("swath-display", kListen)) {
    grow(servers);
    display_address_ = listening_address(*display_);
}

void RemoteCluster::grow(int servers) {
    while (servers_.size() < static_cast<std::size_t>(servers))
        servers_.push_back(start_("swath-server", kListen));
    for (std::size_t i = server_addresses_.size(); i < servers_.size(); ++i)
        server_addresses_.push_back(listening_address(*servers_[i]));
}

void RemoteCluster::stop() {
    std::vector<Process*> all{display_.get()};
    for (const auto& server : servers_) all.push_back(server.get());
    for (const Process* process : all) process->signal(SIGTERM);
    for (Process* process : all) {
        const Finished finished = process->wait(kPatience);
        expect_no_crash(finished);
        EXPECT_EQ(finished.exit_code, 0) << "signal " << finished.signal << '\n' << finished.err;
    }
}

Arguments RemoteCluster::flags(std::size_t servers) const {
    const auto end = server_addresses_.begin() + static_cast<std::ptrdiff_t>(servers);
    return {"--servers", fmt::format("{}", fmt::join(server_addresses_.begin(), end, ",")), "--display",
            display_address_};
}

std::vector<std::string> file_names(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    if (std::filesystem::exists(folder))
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string contents(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void expect_same_pictures(const std::filesystem::path& expected, const std::filesystem::path& actual) {
    const auto names = file_names(expected);
    EXPECT_FALSE(names.empty()) << expected;
    ASSERT_EQ(names, file_names(actual));
    for (const std::string& name : names)
        if (contents(expected / name) != contents(actual / name))
            ADD_FAILURE() << name << ": "
                          << difference(picture_in(expected / name), picture_in(actual / name));
}

void expect_only(Rgb colour, const std::filesystem::path& folder) {
    for (const std::string& name : file_names(folder))
        EXPECT_TRUE(is_only(colour, picture_in(folder / name))) << name << " shows something";
}

void expect_not_only(Rgb colour, const std::filesystem::path& folder) {
    for (const std::string& name : file_names(folder))
        EXPECT_FALSE(is_only(colour, picture_in(folder / name))) << name << " shows nothing";
}

void expect_no_crash(const Finished& finished) {
    for (const char* sign : {"Sanitizer", "runtime error", "terminate called", "Assertion"})
        EXPECT_EQ(finished.err.find(sign), std::string::npos) << finished.err;
}

void expect_one_error(const Finished& finished, int exit_code, const std::vector<std::string>& words) {
    expect_no_crash(finished);
    EXPECT_EQ(finished.exit_code, exit_code) << "signal " << finished.signal << "\n" << finished.err;
    std::vector<std::string> errors;
    std::istringstream lines(finished.err);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("error: ")) errors.push_back(line);
    ASSERT_EQ(errors.size(), 1u) << finished.err;
    for (const std::string& word : words)
        EXPECT_NE(errors[0].find(word), std::string::npos) << "'" << word << "' is not in: " << errors[0];
}

}  // namespace swath::test
